"""Planning problems as PDDL files that any planner takes: no variables, no quantifiers.

A last action stands for each alternative of the goal, because K* refuses negative goals
(docs/semantics.md, D12).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.files.writing import write_atomically
from skillwrapper.grounding import TRUE, GroundOperator
from skillwrapper.planning.problem import PlanningProblem, action_name, finish_name
from skillwrapper.symbols.pddl_layout import comment
from skillwrapper.symbols.pddl_names import unique_name

_OPEN, _DONE = "open", "done"


@dataclass(frozen=True)
class PlannerFiles:
    """The two files of a problem.

    Attributes:
        domain: path of the domain file.
        problem: path of the problem file.
    """

    domain: Path
    problem: Path


def write_pddl(problem: PlanningProblem, folder: Path) -> PlannerFiles:
    """Write ``domain.pddl`` and ``problem.pddl`` into a folder, which is made if need be.

    Raises:
        FileError: if they cannot be written there.
    """
    files = PlannerFiles(folder / "domain.pddl", folder / "problem.pddl")
    printer = _Printer(problem, _atom_names(problem))
    write_atomically(files.domain, printer.domain())
    write_atomically(files.problem, printer.problem())
    return files


def _atom_names(problem: PlanningProblem) -> tuple[str, ...]:
    taken = {_OPEN, _DONE, *map(action_name, range(len(problem.actions)))}
    taken |= set(map(finish_name, range(len(problem.goal.alternatives))))
    learned = ("--".join((atom.predicate, *atom.terms)) for atom in problem.space.atoms)
    return tuple(unique_name(name, taken) for name in learned)


@dataclass(frozen=True)
class _Printer:
    task: PlanningProblem
    atoms: tuple[str, ...]

    def domain(self) -> str:
        conditional = any(action.conditional for action in self.task.actions)
        effects = " :conditional-effects" if conditional else ""
        lines = [
            "(define (domain scene)",
            f"  (:requirements :strips :negative-preconditions{effects})",
            "  (:predicates",
            *(f"    ({name})" for name in (_OPEN, _DONE, *self.atoms)),
            "  )",
        ]
        for number, action in enumerate(self.task.actions):
            lines += [f" {comment(str(action.instance))}"]
            lines += _action(action_name(number), self._needs(action), self._changes(action))
        for number, columns in enumerate(self.task.goal_columns):
            needs = [f"({_OPEN})", *self._literals(columns.items())]
            lines += _action(finish_name(number), needs, [f"(not ({_OPEN}))", f"({_DONE})"])
        return "\n".join(lines) + "\n)\n"

    def problem(self) -> str:
        true = [name for name, value in zip(self.atoms, self.task.initial, strict=True) if value]
        facts = [f"    ({name})" for name in (_OPEN, *true)]
        head = "(define (problem now)\n  (:domain scene)\n  (:init\n"
        return head + "\n".join(facts) + f"\n  )\n  (:goal (and ({_DONE})))\n)\n"

    def _needs(self, action: GroundOperator) -> Iterator[str]:
        yield f"({_OPEN})"
        yield from (f"({self.atoms[column]})" for column in action.required_true)
        yield from (f"(not ({self.atoms[column]}))" for column in action.required_false)

    def _changes(self, action: GroundOperator) -> Iterator[str]:
        yield from (f"({self.atoms[column]})" for column in action.added)
        yield from (f"(not ({self.atoms[column]}))" for column in action.deleted)
        for effect in action.conditional:
            if effect.column in (*action.added, *action.deleted):
                continue  # what happens anyway wins over what happens on a condition
            condition = [(int(c), TRUE) for c in effect.required_true]
            condition += [(int(c), 0) for c in effect.required_false]
            (change,) = self._literals([(effect.column, effect.becomes)])
            when = " ".join(self._literals(condition))
            yield f"(when (and {when}) {change})" if condition else change

    def _literals(self, columns: Iterable[tuple[int, int]]) -> Iterator[str]:
        for column, value in columns:
            yield f"({self.atoms[column]})" if value == TRUE else f"(not ({self.atoms[column]}))"


def _action(name: str, needs: Iterable[str], changes: Iterable[str]) -> list[str]:
    return [
        f"  (:action {name}",
        "    :parameters ()",
        f"    :precondition (and {' '.join(needs)})",
        f"    :effect (and {' '.join(changes)})",
        "  )",
    ]

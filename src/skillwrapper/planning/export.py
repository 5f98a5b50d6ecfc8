"""A model, and a problem, as files for other planners, with a table back to the robot's skills."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from skillwrapper.errors import UnknownNameError
from skillwrapper.files.writing import write_atomically, write_json
from skillwrapper.planning.goals import Goal
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Operator
from skillwrapper.symbols.pddl import print_domain, print_problem
from skillwrapper.symbols.pddl_names import PlannerNames, variable_names
from skillwrapper.symbols.positive_pddl import PositivePddl
from skillwrapper.symbols.predicates import Atom
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


class Dialect(StrEnum):
    """For whom a model is written."""

    PDDL = "pddl"
    """Planners that take negation, disjunction and quantifiers."""
    UP = "up"
    """The same, with a program that makes a unified-planning ``Problem`` of it."""
    PLANSYS2 = "plansys2"
    """Planners that take conjunctions of atoms only, such as POPF."""


@dataclass(frozen=True)
class ActionRow:
    """An action of the files, and the skill that it stands for.

    Attributes:
        action: its name in the files.
        operator: the operator's name in the model.
        skill: the skill to run.
        arguments: the action's parameters that are the skill's arguments; they come first.
        context: its other parameters, which the robot is not told.
        chosen: objects that the action is limited to, by parameter.
    """

    action: str
    operator: str
    skill: str
    arguments: tuple[str, ...]
    context: tuple[str, ...]
    chosen: Mapping[str, str]

    @classmethod
    def of(cls, action: str, operator: Operator, chosen: Mapping[str, str]) -> ActionRow:
        """The row of an action."""
        names = variable_names(v.name for v in operator.parameters)
        written = tuple(names[v.name] for v in operator.parameters)
        own, context = written[: operator.arity], written[operator.arity :]
        limited = {names[name]: item for name, item in chosen.items()}
        return cls(action, operator.name, operator.skill, own, context, limited)


@dataclass(frozen=True)
class SkillTable:
    """From what a planner says to what the robot runs.

    Attributes:
        rows: of all actions.
        objects: the domain's names of objects, by those in the files.
    """

    rows: tuple[ActionRow, ...]
    objects: Mapping[str, str]

    def instance(self, action: str, arguments: Sequence[str]) -> SkillInstance:
        """The skill instance of a step of a plan, e.g. of ``(pick_1 robot cup shelf)``.

        Args:
            action: the name of the action, in any case.
            arguments: its arguments, in any case.

        Raises:
            UnknownNameError: if there is no such action or object.
        """
        rows = {row.action: row for row in self.rows}
        row = rows.get(action.lower())
        if row is None:
            raise UnknownNameError("action", action, rows)
        own = [name.lower() for name in arguments[: len(row.arguments)]]
        for name in own:
            if name not in self.objects:
                raise UnknownNameError("object", name, self.objects)
        return SkillInstance(row.skill, tuple(self.objects[name] for name in own))

    def to_json(self) -> dict[str, Any]:
        """The table as plain data."""
        rows = [
            {
                "action": row.action,
                "operator": row.operator,
                "skill": row.skill,
                "arguments": list(row.arguments),
                "context": list(row.context),
                **({"only for": dict(row.chosen)} if row.chosen else {}),
            }
            for row in self.rows
        ]
        return {"actions": rows, "objects": dict(self.objects)}


@dataclass(frozen=True)
class Export:
    """A model as text for other planners.

    Attributes:
        domain: the PDDL domain.
        problems: PDDL problems, one of which must be solved; none without a task.
        table: from actions to skills.
    """

    domain: str
    problems: tuple[str, ...]
    table: SkillTable

    def write(self, folder: Path) -> tuple[Path, ...]:
        """Write ``domain.pddl``, ``problem.pddl`` (more are numbered) and ``skills.json``.

        Raises:
            FileError: if they cannot be written there.
        """
        files = {folder / "domain.pddl": self.domain}
        for number, problem in enumerate(self.problems, start=1):
            name = "problem.pddl" if number == 1 else f"problem-{number}.pddl"
            files[folder / name] = problem
        for path, text in files.items():
            write_atomically(path, text)
        write_json(folder / "skills.json", self.table.to_json())
        return (*files, folder / "skills.json")


@dataclass(frozen=True)
class Task:
    """What to plan for.

    Attributes:
        true: the ground atoms that are true at the start; all others are taken as false.
        goal: what to reach.
    """

    true: frozenset[Atom]
    goal: Goal


def export(model: AbstractModel, scene: Scene, dialect: Dialect, task: Task | None) -> Export:
    """Write a model down for other planners.

    Args:
        model: the model.
        scene: the objects of the problem; for ``plansys2`` of the domain, too.
        dialect: for whom.
        task: start and goal; None for the domain alone.

    Raises:
        SymbolError: if an operator cannot be told to planners of that kind.
    """
    if dialect is Dialect.PLANSYS2:
        return _positive(model, scene, task)
    names = PlannerNames.of(model, scene.objects)
    operators = sorted(model.operators, key=lambda o: o.name)
    rows = tuple(ActionRow.of(names.operators[o.name], o, {}) for o in operators)
    problems: tuple[str, ...] = ()
    if task is not None:
        problems = (print_problem(model, scene.objects, task.true, *task.goal.alternatives),)
    return Export(print_domain(model), problems, SkillTable(rows, _inverse(names.objects)))


def _positive(model: AbstractModel, scene: Scene, task: Task | None) -> Export:
    printer = PositivePddl(model, tuple(scene.objects))
    rows = tuple(ActionRow.of(a.name, a.operator, a.chosen) for a in printer.actions)
    goals = task.goal.alternatives if task else ()
    problems = tuple(printer.problem(task.true, goal) for goal in goals) if task else ()
    table = SkillTable(rows, _inverse(printer.names.objects))
    return Export(printer.domain(), problems, table)


def _inverse(names: Mapping[str, str]) -> dict[str, str]:
    return {safe: name for name, safe in names.items()}

"""Planning problems in the format that the planner's search reads (Fast Downward's SAS, version 3).

The operators are ground already, so the translator, which takes most of a planner call, is not
needed. Every atom is a variable of two values.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from skillwrapper.grounding import TRUE, GroundOperator
from skillwrapper.planning.problem import PlanningProblem, action_name, finish_name

_HOLDS, _FAILS = 0, 1
_STAGE, _OPEN, _DONE = 0, 1, 0
"""Variable 0 says whether the plan has been finished."""

Facts = dict[int, int]


@dataclass(frozen=True)
class SasEffect:
    """One variable's change, if the condition holds."""

    condition: tuple[tuple[int, int], ...]
    variable: int
    value: int


@dataclass(frozen=True)
class SasOperator:
    """A ground action over variables with two values.

    Attributes:
        name: name in the plans.
        needs: the value that variables must have.
        effects: what changes; nothing that the needs say already.
    """

    name: str
    needs: Facts
    effects: tuple[SasEffect, ...]

    @property
    def sources(self) -> set[int]:
        """The variables that decide what the operator does."""
        return set(self.needs) | {v for e in self.effects for v, _ in e.condition}


def print_sas(problem: PlanningProblem) -> str:
    """The problem as text for the planner's search."""
    operators = [_operator(n, action) for n, action in enumerate(problem.actions)]
    finishes = [_finish(n, columns) for n, columns in enumerate(problem.goal_columns)]
    relevant = _relevant_variables([*operators, *finishes])
    operators = [_restricted(operator, relevant) for operator in operators]
    kept = [operator for operator in [*operators, *finishes] if operator.effects]
    initial = [_OPEN, *(_value(v) for v in problem.initial)]
    number = {variable: position for position, variable in enumerate(sorted(relevant))}
    lines = ["begin_version", "3", "end_version", "begin_metric", "0", "end_metric"]
    lines += [str(len(number)), *(line for v in number for line in _variable(v)), "0"]
    lines += ["begin_state", *(str(initial[v]) for v in number), "end_state"]
    lines += ["begin_goal", "1", f"{number[_STAGE]} {_DONE}", "end_goal", str(len(kept))]
    lines += [line for operator in kept for line in _lines(operator, number)]
    return "\n".join([*lines, "0"]) + "\n"


def _value(label: int) -> int:
    return _HOLDS if label == TRUE else _FAILS


def _finish(number: int, goal: dict[int, int]) -> SasOperator:
    needs = {_STAGE: _OPEN} | {column + 1: _value(label) for column, label in goal.items()}
    return SasOperator(finish_name(number), needs, (SasEffect((), _STAGE, _DONE),))


def _operator(number: int, action: GroundOperator) -> SasOperator:
    needs = {_STAGE: _OPEN}
    needs |= {int(column) + 1: _HOLDS for column in action.required_true}
    needs |= {int(column) + 1: _FAILS for column in action.required_false}
    sure = {int(column) + 1: _FAILS for column in action.deleted}
    sure |= {int(column) + 1: _HOLDS for column in action.added}
    effects = [SasEffect((), variable, value) for variable, value in sorted(sure.items())]
    for effect in action.conditional:
        condition = [(int(column) + 1, _HOLDS) for column in effect.required_true]
        condition += [(int(column) + 1, _FAILS) for column in effect.required_false]
        if effect.column + 1 not in sure:
            effects.append(
                SasEffect(tuple(sorted(condition)), effect.column + 1, _value(effect.becomes))
            )
    changes = tuple(e for e in effects if needs.get(e.variable) != e.value)
    return SasOperator(action_name(number), needs, changes)


def _relevant_variables(operators: Iterable[SasOperator]) -> set[int]:
    """The variables that can matter for finishing, as the translator would keep them."""
    sources: dict[int, set[int]] = {}
    for operator in operators:
        for effect in operator.effects:
            sources.setdefault(effect.variable, set()).update(operator.sources)
    relevant, waiting = {_STAGE}, [_STAGE]
    while waiting:
        found = sources.get(waiting.pop(), set()) - relevant
        relevant |= found
        waiting += found
    return relevant


def _restricted(operator: SasOperator, relevant: set[int]) -> SasOperator:
    needs = {v: value for v, value in operator.needs.items() if v in relevant}
    effects = tuple(e for e in operator.effects if e.variable in relevant)
    return SasOperator(operator.name, needs, effects)


def _variable(variable: int) -> Iterator[str]:
    names = f"Atom a{variable}()", f"NegatedAtom a{variable}()"
    yield from ("begin_variable", f"var{variable}", "-1", "2", *names, "end_variable")


def _lines(operator: SasOperator, number: dict[int, int]) -> Iterator[str]:
    changed = {effect.variable for effect in operator.effects}
    prevail = {v: value for v, value in sorted(operator.needs.items()) if v not in changed}
    yield from ("begin_operator", operator.name, str(len(prevail)))
    yield from (f"{number[v]} {value}" for v, value in prevail.items())
    yield str(len(operator.effects))
    for effect in operator.effects:
        condition = [f"{number[v]} {value}" for v, value in effect.condition]
        before = operator.needs.get(effect.variable, -1)
        change = f"{number[effect.variable]} {before} {effect.value}"
        yield " ".join([str(len(condition)), *condition, change])
    yield from ("1", "end_operator")

"""Planning problems: the ground operators of a scene, where to start and what to reach."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.errors import UnknownNameError
from skillwrapper.grounding import (
    FALSE,
    TRUE,
    UNKNOWN,
    AtomSpace,
    GroundModel,
    GroundOperator,
    Labels,
)
from skillwrapper.grounding.ground_operators import follow, reachable_operators
from skillwrapper.planning.goals import Goal
from skillwrapper.symbols.predicates import Atom, Literal
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class PlanningProblem:
    """A planning problem without variables; universal absences are expanded already.

    Attributes:
        space: the ground atoms.
        actions: the ground operators that may ever apply, in the order of the model, each once.
        initial: the abstract state to start from, of TRUE and FALSE only (shape: atoms).
        guessed: atoms that were unknown at the start and are taken as false.
        goal: what to reach.
    """

    space: AtomSpace
    actions: tuple[GroundOperator, ...]
    initial: Labels
    guessed: tuple[Atom, ...]
    goal: Goal

    @classmethod
    def of(
        cls, model: GroundModel, initial: Labels, goal: Goal | Iterable[Literal]
    ) -> PlanningProblem:
        """Put a problem together.

        Args:
            model: the ground operators of the scene.
            initial: TRUE, FALSE or UNKNOWN for every atom (shape: atoms).
            goal: a goal, or ground literals that must all hold.

        Raises:
            UnknownNameError: if a goal atom is not one of the scene.
        """
        wanted = goal if isinstance(goal, Goal) else Goal.all_of(goal)
        for literal in sorted(frozenset().union(*wanted.alternatives)):
            if literal.atom not in model.space.column:
                raise UnknownNameError(
                    "ground atom", str(literal.atom), map(str, model.space.atoms)
                )
        start = np.where(initial == TRUE, TRUE, FALSE).astype(np.int8)
        return cls(
            space=model.space,
            actions=reachable_operators(model, start),
            initial=start,
            guessed=tuple(model.space.atoms[i] for i in np.flatnonzero(initial == UNKNOWN)),
            goal=wanted,
        )

    @property
    def goal_columns(self) -> tuple[dict[int, int], ...]:
        """For each alternative of the goal, the columns of its atoms and the values they need."""
        column = self.space.column
        return tuple(
            {column[x.atom]: TRUE if x.positive else FALSE for x in sorted(literals)}
            for literals in self.goal.alternatives
        )

    @property
    def is_solved(self) -> bool:
        """Whether the goal holds at the start."""
        return self.goal.holds(self.space, self.initial)

    def is_plan(self, action_numbers: Sequence[int]) -> bool:
        """Whether the actions, one after the other, are applicable and lead to the goal."""
        end = follow((self.actions[number] for number in action_numbers), self.initial)
        return end is not None and self.goal.holds(self.space, end)

    def skills(self, action_numbers: Sequence[int]) -> tuple[SkillInstance, ...]:
        """The skill instances of a plan given as positions in ``actions``."""
        return tuple(self.actions[number].instance for number in action_numbers)


FINISH = "finish"
"""Begins the names of the last actions: one for each alternative of the goal.

It needs the goal and lets nothing follow (docs/semantics.md, D12).
"""

_ACTION, _NUMBERED = "action-", re.compile(r"action-([0-9]{1,9})")


def action_name(number: int) -> str:
    """The name of an action in planner files: its position in the problem's actions."""
    return f"{_ACTION}{number}"


def action_number(name: str) -> int:
    """The position of an action that a planner names; ``ValueError`` if it is none of ours."""
    found = _NUMBERED.fullmatch(name)
    if found is None:
        raise ValueError(f"expected an action such as {action_name(0)}, got '{name}'")
    return int(found[1])


def finish_name(number: int) -> str:
    """The name of the last action for one alternative of the goal."""
    return f"{FINISH}-{number}" if number else FINISH


def is_finish(name: str) -> bool:
    """Whether a planner names a last action."""
    return name.startswith(FINISH)

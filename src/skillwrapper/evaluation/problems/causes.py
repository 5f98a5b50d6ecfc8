"""Why a problem was not solved: the first thing that is not as it truly is."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, GroundModel, Labels
from skillwrapper.planning.result import SkillPlan
from skillwrapper.world.skills import SkillInstance


class Cause(StrEnum):
    """What kept a problem from being solved."""

    START_MISREAD = "start misread"
    """A label of the start picture is wrong or unknown."""
    GOAL_MISREAD = "goal misread"
    """A label of the goal picture is wrong or unknown."""
    PREDICATE_MISSING = "predicate missing"
    """Two true states that differ have the same labels."""
    OPERATOR_MISSING = "operator missing"
    """A skill that works is not predicted to work."""
    EFFECT_WRONG = "effect wrong"
    """An operator predicts another change than the one that happens."""
    SKILL_FAILED = "skill failed"
    """A skill that does not work is predicted to work."""
    PLANNER_OUT_OF_TIME = "planner out of time"
    """The planner found nothing in its time."""
    PLANNER_BROKEN = "planner broken"
    """The planner broke down, for want of memory for instance."""
    WRONGLY_IMPOSSIBLE = "claimed impossible"
    """The method says that there is no solution, and nothing else is known to be wrong."""
    WRONGLY_DONE = "claimed done"
    """The method says that the goal is reached, which it is not."""
    OUT_OF_STEPS = "out of steps"
    """The method used all skills that it may execute."""
    NO_PLAN = "no plan"
    """The planner finds no plan, and nobody knows the truth about states that would tell why."""
    GOAL_NOT_REACHED = "goal not reached"
    """All skills of a plan succeeded, but the goal does not hold; likewise."""
    GOAL_NOT_EXPRESSIBLE = "goal not expressible"
    """The model has no predicates for the goal."""
    GOAL_NOT_SHOWN = "goal not shown"
    """The method needs a picture of the goal, and there is none."""
    UNUSABLE_ANSWER = "unusable answer"
    """The model's answer could not be understood."""


@dataclass(frozen=True)
class Diagnosis:
    """A cause, and what exactly was found.

    Attributes:
        cause: the kind of cause.
        detail: in words, for people.
    """

    cause: Cause
    detail: str


@dataclass(frozen=True)
class Diagnostician:
    """Looks for the first thing that is wrong with a model.

    Attributes:
        truth: all states of the scene, and how the model's predicates are labelled without error.
        model: the ground model.
    """

    truth: LabelledStates
    model: GroundModel

    def misread(self, cause: Cause, read: Labels, state: Any) -> Diagnosis | None:
        """Where the labels (atoms,) that were read off a picture are wrong or unknown."""
        true = self._labels(state)
        known = true != UNKNOWN  # of what nobody knows, nobody can say that it is misread
        if not (((read != true) & known) | (read == UNKNOWN)).any():
            return None
        return Diagnosis(cause, _difference(self.model.space, read, true))

    def blind(self, first: Any, second: Any) -> Diagnosis | None:
        """Whether two different states look alike to the model."""
        if first == second or (self._labels(first) != self._labels(second)).any():
            return None
        return Diagnosis(Cause.PREDICATE_MISSING, "start and goal have the same labels")

    def no_plan(self, start: Any, goal: Any) -> Diagnosis:
        """Why there is no abstract plan, though there may be a true solution."""
        state, space = start, self.truth.states.space
        for step in space.path_between(space.index[start], space.index[goal]) or ():
            after = self._after(state, step)[1]
            before, expected = self._labels(state), self._labels(after)
            following = self.model.successors(before[np.newaxis], step)
            if not len(following):
                return Diagnosis(Cause.OPERATOR_MISSING, f"{step} works, but no operator applies")
            if not (following == expected).all(axis=1).any():
                difference = _difference(self.model.space, following[0], expected)
                return Diagnosis(Cause.EFFECT_WRONG, f"{step}: {difference}")
            state = after
        return Diagnosis(Cause.WRONGLY_IMPOSSIBLE, "every step of a solution is predicted rightly")

    def bad_plan(self, start: Any, goal: Any, plan: SkillPlan) -> Diagnosis:
        """Why a plan of the model does not lead to the goal, though all labels were right."""
        imagined, state = self._labels(start)[np.newaxis], start
        for step in plan:
            succeeded, state = self._after(state, step)
            if not succeeded:
                return Diagnosis(Cause.SKILL_FAILED, f"{step} is predicted to work, and fails")
            true = self._labels(state)
            imagined = self.model.successors(imagined, step)
            if not (imagined == true).all(axis=1).any():
                shown = imagined[0] if len(imagined) else true
                difference = _difference(self.model.space, shown, true)
                return Diagnosis(Cause.EFFECT_WRONG, f"{step}: {difference}")
        if (self._labels(state) == self._labels(goal)).all():
            return Diagnosis(Cause.PREDICATE_MISSING, "what was reached has the labels of the goal")
        return Diagnosis(Cause.EFFECT_WRONG, "what was reached is predicted to be the goal")

    def _labels(self, state: Any) -> Labels:
        row = self.truth.states.space.index[state]
        labels: Labels = self.truth.labels(self.model.space)[row]
        return labels

    def _after(self, state: Any, step: SkillInstance) -> tuple[bool, Any]:
        return self.truth.states.environment.successor(state, step)


def _difference(space: AtomSpace, found: Labels, expected: Labels) -> str:
    words = {TRUE: "true", UNKNOWN: "unknown"}
    return ", ".join(
        f"{space.atoms[column]} is {words.get(int(expected[column]), 'false')}, "
        f"not {words.get(int(found[column]), 'false')}"
        for column in np.flatnonzero(found != expected)
    )

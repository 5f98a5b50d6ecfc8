"""Carrying out plans of a learned model in a world that may go another way.

The plan starts from what is seen now. Before and after each skill the picture is read and compared
with what the model said; on a surprise the picture is taken again, and if it stays, planned anew.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import TRUE, UNKNOWN
from skillwrapper.planning.goals import Goal
from skillwrapper.planning.result import SkillPlan
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.carrying_out import (
    Confirm,
    Ending,
    Execution,
    ExecutionSettings,
    Tell,
    agree,
    say_nothing,
)
from skillwrapper.runs.execution_records import ExecutionRecord
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.symbols.predicates import Literal
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance

_PLANS = 10
"""So many plans are looked at for one that runs no skill where it failed before."""


@dataclass(frozen=True)
class _Seen:
    """What is seen, what is true then, and what of it was expected otherwise."""

    observation: Observation
    state: AbstractState
    differences: tuple[Literal, ...] = ()


class CarefulExecution(Execution):
    """Brings about a goal, looking before and after each skill.

    Args:
        learned: the model.
        environment: the robot, ready to look.
        goal: what to bring about.
        record: where it is written down.
        settings: how patient it is.
        confirm: asked before the first skill.
        tell: told what happens, for people.
    """

    def __init__(
        self,
        learned: LearnedModel,
        environment: Environment,
        goal: Goal,
        record: ExecutionRecord,
        settings: ExecutionSettings | None = None,
        confirm: Confirm = agree,
        tell: Tell = say_nothing,
    ) -> None:
        super().__init__(learned, environment, record, settings, confirm, tell)
        self._goal = goal
        self._failed: set[tuple[bytes, SkillInstance]] = set()

    def _carry_out(self) -> None:
        now = self._first_look()
        while not now.state.satisfies(self._goal):
            if self.report.plans > self._settings.replans:
                self._end(Ending.NOT_REACHED, f"{self.report.plans} plans were tried")
                return
            plan = self._plan(now.state)
            if plan is None:
                return
            now = self._follow(plan, now)
        self._end(Ending.REACHED)

    def _plan(self, state: AbstractState) -> SkillPlan | None:
        """The plan to follow; None if there is none, or nobody wants it."""
        found = self._learned.plan(
            state, self._goal, plans=_PLANS, time_limit=self._settings.plan_limit
        )
        plans = [plan for plan in found.plans if not self._repeats_failure(plan, state)]
        if not plans:
            repeats = "every plan runs a skill where it failed before"
            cause = repeats if found.plans else found.cause or str(found.status)
            self._end(Ending.NO_PLAN, cause)
            return None
        return plans[0] if self._begin(plans[0], state) else None

    def _repeats_failure(self, plan: SkillPlan, state: AbstractState) -> bool:
        """Whether a plan leads to a state in which its next skill failed before."""
        for instance in plan:
            if (state.labels.tobytes(), instance) in self._failed:
                return True
            state = self._learned.expected(state, instance).state
        return False

    def _follow(self, plan: Sequence[SkillInstance], now: _Seen) -> _Seen:
        """Run skills as long as all goes as the model says; what is seen then."""
        for instance in plan:
            now = self._settle(now.state, self._look())
            if now.differences:
                self._surprise("moved", None, now.differences)
                return now
            outcome = self._execute(now.observation, instance)
            if not outcome.success:
                self._failed.add((now.state.labels.tobytes(), instance))
            expected = self._learned.expected(now.state, instance).state
            now = self._settle(expected if outcome.success else now.state, outcome.observation)
            if now.differences or not outcome.success:
                kind = "effect" if outcome.success else "failed"
                self._surprise(kind, instance, now.differences)
                return now
        return now

    def _first_look(self) -> _Seen:
        seen = self._look()
        return _Seen(seen, self._learned.read(seen, scene=self._environment.scene))

    def _settle(self, expected: AbstractState, seen: Observation) -> _Seen:
        """What is true now; where it is not as expected, the picture is taken and read again.

        What nobody can tell from the picture is taken to be as expected.
        """
        first = self._against(expected, seen)
        if not first.differences:
            return first
        return self._against(expected, self._look())

    def _against(self, expected: AbstractState, seen: Observation) -> _Seen:
        self.report.last = seen
        read = self._learned.read(seen, scene=expected.scene)
        labels = np.where(read.labels == UNKNOWN, expected.labels, read.labels)
        known = (labels != expected.labels) & (expected.labels != UNKNOWN)
        atoms = read.space.atoms
        differences = tuple(
            Literal(atoms[i], bool(labels[i] == TRUE)) for i in np.flatnonzero(known)
        )
        return _Seen(seen, AbstractState(expected.scene, read.space, labels), differences)

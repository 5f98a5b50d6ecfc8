"""Carrying out plans of a learned model in a world that may go another way.

The plan starts from what is seen now. Before and after each skill the picture is read and compared
with what the model said; on a surprise the picture is taken again, and if it stays, planned anew.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.errors import EmergencyStopError, RobotError
from skillwrapper.grounding import TRUE, UNKNOWN
from skillwrapper.planning.goals import Goal
from skillwrapper.planning.result import SkillPlan
from skillwrapper.redaction import without_secrets
from skillwrapper.robots.guarded import check_halted, execute_guarded
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.execution_records import ExecutionRecord, Surprise
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.symbols.predicates import Literal
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance

_PLANS = 10
"""So many plans are looked at for one that runs no skill where it failed before."""


class ExecutionSettings(BaseModel):
    """How patient an execution is."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    replans: int = Field(
        default=5, ge=0, description="how often to plan anew", json_schema_extra={"unit": "plans"}
    )
    skill_limit: float = Field(
        default=300.0,
        gt=0.0,
        description="how long a skill may take",
        json_schema_extra={"unit": "seconds"},
    )
    plan_limit: float = Field(
        default=30.0,
        gt=0.0,
        description="how long planning may take",
        json_schema_extra={"unit": "seconds"},
    )


class Ending(StrEnum):
    """How an execution ended."""

    REACHED = "reached"
    """The goal holds by the labels of the last picture."""
    NOT_REACHED = "not reached"
    """The labels say so, though the plan was carried out, and nothing may be planned anew."""
    NO_PLAN = "no plan"
    """The model knows no way from what is seen."""
    DECLINED = "declined"
    """Nobody agreed to the plan."""
    STOPPED = "stopped"
    """By the emergency stop."""
    BROKEN = "broken"
    """The robot hung or failed."""


@dataclass
class ExecutionReport:
    """What came of an execution.

    Attributes:
        ending: how it ended.
        reason: in words; empty if there is nothing to add.
        executed: the skills that were run, each with its success.
        surprises: in order of time.
        plans: how many plans were made.
        last: what was seen last.
    """

    ending: Ending = Ending.NO_PLAN
    reason: str = ""
    executed: list[tuple[SkillInstance, bool]] = field(default_factory=list)
    surprises: list[Surprise] = field(default_factory=list)
    plans: int = 0
    last: Observation | None = None


@dataclass(frozen=True)
class _Seen:
    """What is seen, what is true then, and what of it was expected otherwise."""

    observation: Observation
    state: AbstractState
    differences: tuple[Literal, ...] = ()


Confirm = Callable[[SkillPlan, AbstractState], bool]
"""Whether a plan may be carried out from a state; asked before the first skill only."""

Tell = Callable[[str], object]


def _agree(plan: SkillPlan, state: AbstractState) -> bool:
    return True


def _say_nothing(text: str) -> None:
    return None


class CarefulExecution:
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
        confirm: Confirm = _agree,
        tell: Tell = _say_nothing,
    ) -> None:
        self._learned, self._environment, self._goal = learned, environment, goal
        self._record, self._confirm, self._tell = record, confirm, tell
        self._settings = settings or ExecutionSettings()
        self._failed: set[tuple[bytes, SkillInstance]] = set()
        self.report = ExecutionReport()

    def run(self) -> ExecutionReport:
        """Carry it out; whatever happens is recorded, and ends here.

        Raises:
            ProviderError: if a model does not answer.
            UserError: if the record cannot be written.
        """
        try:
            self._carry_out()
        except EmergencyStopError as error:
            self._end(Ending.STOPPED, str(error))
        except RobotError as error:
            self._end(Ending.BROKEN, str(error))
        except BaseException as error:
            self._record.note("ended", ending="interrupted", reason=type(error).__name__)
            raise
        self._record.note("ended", ending=self.report.ending, reason=self.report.reason)
        return self.report

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
        self.report.plans += 1
        self._record.plan(plans[0])
        if self.report.plans > 1:
            self._tell("planned anew: " + ", ".join(map(str, plans[0])))
        elif not self._confirm(plans[0], state):
            self._end(Ending.DECLINED)
            return None
        return plans[0]

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
                self._surprise("moved", None, now)
                return now
            outcome = execute_guarded(self._environment, instance, self._settings.skill_limit)
            after = outcome.observation
            done = Transition(now.observation, instance, outcome.success, after, outcome.changed)
            self._note_executed(now.state, done, without_secrets(outcome.message))
            expected = self._learned.expected(now.state, instance).state
            now = self._settle(expected if outcome.success else now.state, after)
            if now.differences or not outcome.success:
                self._surprise("effect" if outcome.success else "failed", instance, now)
                return now
        return now

    def _note_executed(self, state: AbstractState, done: Transition, message: str) -> None:
        self._record.transition(state.scene, done, message)
        self.report.executed.append((done.instance, done.success))
        how = "done" if done.success else f"failed{f': {message}' if message else ''}"
        self._tell(f"  {done.instance}: {how}")
        if not done.success:
            self._failed.add((state.labels.tobytes(), done.instance))

    def _look(self) -> Observation:
        check_halted(self._environment)
        self.report.last = self._environment.observe()
        return self.report.last

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

    def _surprise(self, kind: str, instance: SkillInstance | None, now: _Seen) -> None:
        surprise = Surprise(len(self.report.executed), kind, instance, now.differences)
        self.report.surprises.append(surprise)
        self._record.surprise(surprise)
        self._tell(f"surprise: {surprise}")

    def _end(self, ending: Ending, reason: str = "") -> None:
        self.report.ending, self.report.reason = ending, without_secrets(reason)

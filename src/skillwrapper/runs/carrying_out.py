"""What every execution of a goal has in common: it looks, it runs skills, and it writes down."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.errors import EmergencyStopError, RobotError
from skillwrapper.planning.result import SkillPlan
from skillwrapper.redaction import without_secrets
from skillwrapper.robots.guarded import check_halted, execute_guarded
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.execution_records import ExecutionRecord, Surprise
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.symbols.predicates import Literal
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Outcome, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance


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


Confirm = Callable[[SkillPlan, AbstractState], bool]
"""Whether a plan may be carried out from a state; asked before the first skill only."""

Tell = Callable[[str], object]


def agree(plan: SkillPlan, state: AbstractState) -> bool:
    """To whatever plan."""
    return True


def say_nothing(text: str) -> None:
    """To nobody."""
    return


class Execution(ABC):
    """Brings about a goal; whatever happens is told and recorded.

    Args:
        learned: the model.
        environment: the robot, ready to look.
        record: where it is written down.
        settings: how patient it is.
        confirm: asked before the first skill.
        tell: told what happens, for people.
    """

    def __init__(
        self,
        learned: LearnedModel,
        environment: Environment,
        record: ExecutionRecord,
        settings: ExecutionSettings | None = None,
        confirm: Confirm = agree,
        tell: Tell = say_nothing,
    ) -> None:
        self._learned, self._environment = learned, environment
        self._record, self._confirm, self._tell = record, confirm, tell
        self._settings = settings or ExecutionSettings()
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

    @abstractmethod
    def _carry_out(self) -> None:
        """Plan and run skills, until the end is noted."""

    def _begin(self, plan: SkillPlan, state: AbstractState) -> bool:
        """Take up a plan; whether it is agreed to, which is asked of the first one only."""
        self.report.plans += 1
        self._record.plan(plan)
        if self.report.plans > 1:
            self._tell("planned anew: " + ", ".join(map(str, plan)))
        elif not self._confirm(plan, state):
            self._end(Ending.DECLINED)
            return False
        return True

    def _look(self) -> Observation:
        check_halted(self._environment)
        self.report.last = self._environment.observe()
        return self.report.last

    def _execute(self, before: Observation, instance: SkillInstance) -> Outcome:
        """Run a skill, and write down what came of it."""
        self._record.note("started", skill=str(instance))  # first: it may be the robot's last
        outcome = execute_guarded(self._environment, instance, self._settings.skill_limit)
        after = outcome.observation
        done = Transition(before, instance, outcome.success, after, outcome.changed)
        message = without_secrets(outcome.message)
        self._record.transition(self._environment.scene, done, message)
        self.report.executed.append((instance, outcome.success))
        self.report.last = after
        how = "done" if outcome.success else f"failed{f': {message}' if message else ''}"
        self._tell(f"  {instance}: {how}")
        return outcome

    def _surprise(
        self, kind: str, instance: SkillInstance | None, seen: tuple[Literal, ...] = ()
    ) -> None:
        surprise = Surprise(len(self.report.executed), kind, instance, seen)
        self.report.surprises.append(surprise)
        self._record.surprise(surprise)
        self._tell(f"surprise: {surprise}")

    def _end(self, ending: Ending, reason: str = "") -> None:
        self.report.ending, self.report.reason = ending, without_secrets(reason)

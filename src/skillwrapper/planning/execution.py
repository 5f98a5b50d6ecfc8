"""Trying plans in an environment, one after the other (docs/semantics.md D13)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from skillwrapper.planning.result import SkillPlan
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation

PLANNING_BUDGET = 10
"""At most so many plans are tried; also the budget that an unsolved problem counts with."""


@dataclass(frozen=True)
class Attempt:
    """One plan, run from the start of the problem until its end or the first failed skill.

    Attributes:
        plan: the skill plan.
        start: what was seen before the first skill.
        outcomes: one for every skill that was run; only the last one may be a failure.
        goal_reached: whether the true goal held in the end.
    """

    plan: SkillPlan
    start: Observation
    outcomes: tuple[Outcome, ...]
    goal_reached: bool

    @property
    def failed_at(self) -> int | None:
        """Position in the plan of the skill that failed; None if all succeeded."""
        if self.outcomes and not self.outcomes[-1].success:
            return len(self.outcomes) - 1
        return None

    @property
    def succeeded(self) -> bool:
        """Whether every skill succeeded and the true goal holds."""
        return self.failed_at is None and self.goal_reached

    @property
    def observations(self) -> tuple[Observation, ...]:
        """What was seen at the start and after each skill."""
        return (self.start, *(outcome.observation for outcome in self.outcomes))

    def to_json(self) -> dict[str, Any]:
        """Plain data, pictures by their keys."""
        failed = self.failed_at
        return {
            "plan": [str(instance) for instance in self.plan],
            "succeeded": self.succeeded,
            "goal_reached": self.goal_reached,
            "failed_at": failed,
            "message": "" if failed is None else self.outcomes[failed].message,
            "observations": [observation.key for observation in self.observations],
        }


@dataclass(frozen=True)
class ExecutionReport:
    """All attempts at one problem; they end with the first success.

    Attributes:
        attempts: in the order of the plans.
    """

    attempts: tuple[Attempt, ...]

    @property
    def solved(self) -> bool:
        """Whether an attempt succeeded."""
        return bool(self.attempts) and self.attempts[-1].succeeded

    @property
    def budget(self) -> int:
        """The planning budget: number of plans tried, 10 if the problem was not solved."""
        return len(self.attempts) if self.solved else PLANNING_BUDGET

    @property
    def executions(self) -> int:
        """Number of skills that were run."""
        return sum(len(attempt.outcomes) for attempt in self.attempts)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "solved": self.solved,
            "budget": self.budget,
            "executions": self.executions,
            "attempts": [attempt.to_json() for attempt in self.attempts],
        }


def attempt(
    environment: Environment,
    prepare: Callable[[], object],
    plans: Sequence[SkillPlan],
    goal_reached: Callable[[], bool],
) -> ExecutionReport:
    """Run plans until one succeeds, at most ten.

    Args:
        environment: where the skills are run.
        prepare: puts the environment into the start of the problem; called before every plan.
        plans: skill plans, the most promising first.
        goal_reached: whether the true goal holds in the environment now.

    Raises:
        RobotError: if the robot or simulator itself fails.
    """
    attempts: list[Attempt] = []
    for plan in plans[:PLANNING_BUDGET]:
        prepare()
        attempts.append(run_plan(environment, plan, goal_reached))
        if attempts[-1].succeeded:
            break
    return ExecutionReport(tuple(attempts))


def run_plan(
    environment: Environment, plan: SkillPlan, goal_reached: Callable[[], bool]
) -> Attempt:
    """Run one plan from where the environment is, until its end or the first failed skill.

    Raises:
        RobotError: if the robot or simulator itself fails.
    """
    start = environment.observe()
    outcomes: list[Outcome] = []
    for instance in plan:
        outcomes.append(environment.execute(instance))
        if not outcomes[-1].success:
            break
    return Attempt(plan, start, tuple(outcomes), goal_reached())

"""Solving a problem from its start with a learned model: with what is read, or under doubt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from skillwrapper.planning.execution import ExecutionReport, attempt
from skillwrapper.planning.goals import Goal
from skillwrapper.planning.hypotheses.attempts import attempt_in_doubt
from skillwrapper.planning.hypotheses.beliefs import Beliefs
from skillwrapper.planning.result import PlanningResult, PlanningStatus
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world.environment import Environment
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True)
class Solution:
    """What came of a problem.

    Attributes:
        found: what planning came to, with the first plan at least if there is one.
        report: the plans that were run.
    """

    found: PlanningResult
    report: ExecutionReport


class Way(Protocol):
    """How a problem is solved."""

    @property
    def has_plan(self) -> bool:
        """Whether there is anything to run."""
        ...

    def carry_out(self, environment: Environment, prepare: Callable[[], object]) -> Solution:
        """Run plans, each from the start of the problem, until one succeeds.

        Args:
            environment: where the skills are run.
            prepare: puts it into the start of the problem.

        Raises:
            RobotError: if the robot or simulator itself fails.
            ProviderError: if a model does not answer.
        """
        ...


@dataclass(frozen=True)
class AsRead:
    """The plans of the planner, for start and goal as they are read.

    Attributes:
        learned: the model.
        scene: what is present.
        found: the plans.
        goal: what is wanted.
    """

    learned: LearnedModel
    scene: Scene
    found: PlanningResult
    goal: Goal

    @property
    def has_plan(self) -> bool:
        """Whether there is anything to run."""
        return bool(self.found.plans)

    def carry_out(self, environment: Environment, prepare: Callable[[], object]) -> Solution:
        """As ``Way`` says."""

        def is_reached() -> bool:
            return self.learned.read(environment.observe(), scene=self.scene).satisfies(self.goal)

        return Solution(self.found, attempt(environment, prepare, self.found.plans, is_reached))


@dataclass(frozen=True)
class InDoubt:
    """The plans of hypotheses, the likeliest first.

    Attributes:
        learned: the model.
        scene: what is present.
        beliefs: of start and goal.
    """

    learned: LearnedModel
    scene: Scene
    beliefs: Beliefs

    @property
    def has_plan(self) -> bool:
        """Whether there is anything to run."""
        return self.beliefs.next_plan() is not None

    def carry_out(self, environment: Environment, prepare: Callable[[], object]) -> Solution:
        """As ``Way`` says."""

        def is_reached() -> bool:
            seen = self.learned.read(environment.observe(), scene=self.scene)
            return self.beliefs.is_reached(seen.labels)

        trials = attempt_in_doubt(environment, prepare, self.beliefs, is_reached)
        plans = tuple(attempt.plan for attempt in trials.report.attempts[:1])
        claims = PlanningStatus.UNSOLVABLE if trials.claims_impossible else PlanningStatus.TIMEOUT
        status = PlanningStatus.SOLVED if plans else claims
        return Solution(PlanningResult(status, plans, 0.0), trials.report)

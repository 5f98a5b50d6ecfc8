"""What came of one problem."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from skillwrapper.evaluation.problems.causes import Cause, Diagnosis
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass


class Judge(StrEnum):
    """Who said that a goal is reached (docs/semantics.md, D25)."""

    ENVIRONMENT = "environment"
    MODEL = "model"
    """Reached, as far as the learned model can tell."""


@dataclass(frozen=True)
class ProblemResult:
    """How a method did on a problem.

    Attributes:
        problem: name of the problem.
        kind: its class.
        solved: the goal was reached; of an impossible problem, that it was recognised.
        claimed_impossible: the method says that there is no solution. Of methods with a planner
            only a proof within the model counts.
        budget: plans tried, 10 if the problem was not solved (docs/semantics.md, D13); None for
            methods that make no plans, and for impossible problems.
        length: number of skills of the plan that solved it; None if none did.
        optimal: number of skills of an optimal solution; None if there is none.
        executions: skills executed.
        successes: how many of them succeeded.
        planning_seconds: time that the planner took.
        seconds: time of everything.
        calls: questions that were put to models.
        cause: why it was not solved; None if it was.
        detail: the same in words.
        plan: the first plan, or what was executed; for reports.
        judge: who says whether the goal was reached.
        attempts: plans that were run, also before it was claimed that there is no solution.
    """

    problem: str
    kind: ProblemClass
    solved: bool
    claimed_impossible: bool
    budget: int | None
    length: int | None
    optimal: int | None
    executions: int
    planning_seconds: float
    seconds: float
    calls: int
    successes: int = 0
    cause: Cause | None = None
    detail: str = ""
    plan: tuple[str, ...] = ()
    judge: Judge = Judge.ENVIRONMENT
    attempts: int = 0

    @classmethod
    def of(
        cls,
        problem: Problem,
        *,
        solved: bool,
        diagnosis: Diagnosis | None = None,
        **figures: Any,
    ) -> ProblemResult:
        """A result for a problem; a diagnosis counts only if it was not solved."""
        found = None if solved else diagnosis
        return cls(
            problem=problem.name,
            kind=problem.kind,
            solved=solved,
            optimal=problem.length,
            cause=found.cause if found else None,
            detail=found.detail if found else "",
            **figures,
        )

    def to_json(self) -> dict[str, Any]:
        """Plain data with the attributes as keys."""
        return {**vars(self), "plan": list(self.plan)}

"""Trying hypotheses: plans run one after the other, each from the start of the problem (D13)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from skillwrapper.grounding import Labels
from skillwrapper.planning.execution import PLANNING_BUDGET, Attempt, ExecutionReport, run_plan
from skillwrapper.planning.hypotheses.beliefs import Beliefs, Evidence
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation

Read = Callable[[Observation], Labels]
"""Reads a picture: labels (atoms,)."""


@dataclass(frozen=True)
class Trials:
    """What came of trying hypotheses.

    Attributes:
        report: the plans that were run.
        unsolvable: the probability, in the end, of the hypotheses without a plan.
        claims_impossible: whether that is enough to say that there is no solution.
    """

    report: ExecutionReport
    unsolvable: float
    claims_impossible: bool


def attempt_in_doubt(
    environment: Environment,
    prepare: Callable[[], object],
    beliefs: Beliefs,
    goal_reached: Callable[[], bool],
    look_again: Read | None = None,
) -> Trials:
    """Run the plan that is likeliest to succeed, learn from how it went, and again; at most ten.

    Args:
        environment: where the skills are run.
        prepare: puts the environment into the start of the problem; called before every plan.
        beliefs: of start and goal; changed by what is seen.
        goal_reached: whether the true goal holds in the environment now.
        look_again: reads what was seen after skills; None not to.

    Raises:
        RobotError: if the robot or simulator itself fails.
        ProviderError: if pictures are read and a model does not answer.
    """
    attempts: list[Attempt] = []
    while len(attempts) < PLANNING_BUDGET:
        plan = beliefs.next_plan()
        if plan is None:
            break
        prepare()
        attempts.append(run_plan(environment, plan, goal_reached))
        if attempts[-1].succeeded:
            break
        beliefs.learn(_evidence(attempts[-1], look_again))
    report = ExecutionReport(tuple(attempts))
    return Trials(report, beliefs.unsolvable, not report.solved and beliefs.is_impossible)


def _evidence(attempt: Attempt, look_again: Read | None) -> Evidence:
    done = [outcome for outcome in attempt.outcomes if outcome.success]
    seen = [look_again(outcome.observation) for outcome in done] if look_again else []
    return Evidence(attempt.plan, len(done), seen)

from __future__ import annotations

import pytest

from skillwrapper.errors import InternalError
from skillwrapper.planning import PlanningResult, PlanningStatus
from skillwrapper.world import SkillInstance

PICK, CUT = SkillInstance("Pick", ("robot", "patty")), SkillInstance("Cut", ("robot", "lettuce"))


def test_good_results() -> None:
    PlanningResult(PlanningStatus.SOLVED, ((),), 0.0)
    PlanningResult(PlanningStatus.SOLVED, ((PICK,), (CUT,), (PICK, CUT)), 0.1)
    for status in set(PlanningStatus) - {PlanningStatus.SOLVED}:
        PlanningResult(status, (), 1.0, log="what happened")


@pytest.mark.parametrize("status", sorted(set(PlanningStatus) - {PlanningStatus.SOLVED}))
def test_plans_without_a_solution(status: PlanningStatus) -> None:
    with pytest.raises(InternalError, match="if and only if solved"):
        PlanningResult(status, ((PICK,),), 0.0, log="log")


@pytest.mark.parametrize(
    ("plans", "seconds", "expected"),
    [
        ((), 0.0, "if and only if solved"),
        (((PICK,), (PICK,)), 0.0, "got one twice"),
        (((PICK, CUT), (PICK,)), 0.0, "the shortest plans first"),
        (((PICK,),), -1.0, "at least 0 s"),
    ],
)
def test_bad_solutions(
    plans: tuple[tuple[SkillInstance, ...], ...], seconds: float, expected: str
) -> None:
    with pytest.raises(InternalError, match=expected):
        PlanningResult(PlanningStatus.SOLVED, plans, seconds)


def test_error_without_a_log() -> None:
    with pytest.raises(InternalError, match="expected a log"):
        PlanningResult(PlanningStatus.ERROR, (), 0.0)

"""Results of cells without running anything."""

from __future__ import annotations

from collections.abc import Sequence

from skillwrapper.evaluation.benchmark.call_costs import CallCosts
from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.problems.causes import Cause
from skillwrapper.evaluation.problems.problems import ProblemClass
from skillwrapper.evaluation.problems.results import ProblemResult

EASY, HARD, IMPOSSIBLE = ProblemClass


def made_up_problem(
    name: str, kind: ProblemClass, solved: bool, *, claimed: bool = False
) -> ProblemResult:
    possible = kind is not IMPOSSIBLE
    return ProblemResult(
        problem=name,
        kind=kind,
        solved=solved,
        claimed_impossible=claimed or (solved and not possible),
        budget=(1 if solved else 10) if possible else None,
        length=4 if solved and possible else None,
        optimal=2 if possible else None,
        executions=4,
        successes=3,
        planning_seconds=0.5,
        seconds=1.0,
        calls=2,
        cause=None if solved else Cause.OPERATOR_MISSING,
    )


def made_up_cell(
    method: str,
    seed: int,
    solved: Sequence[bool],
    *,
    noise: str = "none",
    recall: float | None = 0.5,
    learned: bool = True,
    cost: float | None = 0.5,
) -> CellResult:
    """A cell with two easy problems, a hard and an impossible one."""
    kinds = (EASY, EASY, HARD, IMPOSSIBLE)
    problems = tuple(
        made_up_problem(f"{kind}-{number}", kind, done, claimed=kind is HARD and not done)
        for number, (kind, done) in enumerate(zip(kinds, solved, strict=True))
    )
    exact = {"precision": 1.0, "recall": recall, "effect_accuracy": 1.0}
    size = {"predicates": 4, "operators": 6}
    point = {"executions": 10, **exact, **size}
    efficiency = {"area": 0.25, "changing": 0.1, "pairs_covered": 0.2, "curve": [point]}
    return CellResult(
        cell=Cell(method, "burger", seed, noise),
        problems=problems,
        exact=None if recall is None else {**exact, **size},
        learning={"executions": 10} if learned else {},
        efficiency=efficiency if learned else None,
        seconds=9.0,
        costs={"learning": _cost(7, cost) if learned else None, "solving": _cost(8, cost)},
    )


def _cost(calls: int, cost: float | None) -> dict[str, object]:
    return CallCosts(calls, cost, None, None, 1.0).to_json()

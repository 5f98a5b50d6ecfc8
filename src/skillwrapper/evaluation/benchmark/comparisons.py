"""Two methods on the same problems with the same seeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.benchmark.figures import Spread


@dataclass(frozen=True)
class PairedComparison:
    """Two methods on the same problems with the same seeds.

    Attributes:
        method: one method.
        other: what it is compared with.
        domain: the domain.
        noise: the noise.
        pairs: number of problems times seeds that both tried.
        wins: solved by the one and not by the other.
        losses: the other way round.
        difference: of the percentage solved, per seed.
        p_value: exact two-sided McNemar test of wins against losses; takes the pairs as
            independent, which problems of one learned model are only in part. None where it would
            be decided by a constant of the stand-in model (docs/semantics.md, D25).
    """

    method: str
    other: str
    domain: str
    noise: str
    pairs: int
    wins: int
    losses: int
    difference: Spread | None
    p_value: float | None

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        difference = self.difference.to_json() if self.difference else None
        p_value = None if self.p_value is None else round(self.p_value, 6)
        return {**vars(self), "difference": difference, "p_value": p_value}


def compare(
    first: Sequence[CellResult], second: Sequence[CellResult], *, testable: bool = True
) -> PairedComparison:
    """Compare two methods, each with at least one cell.

    Args:
        first: cells of the one.
        second: cells of the other.
        testable: whether a test of their difference says anything.
    """
    theirs = {c.cell.seed: {p.problem: p.solved for p in c.problems} for c in second}
    wins = losses = pairs = 0
    differences: list[float | None] = []
    for cell in first:
        other = theirs.get(cell.cell.seed, {})
        both = [(p.solved, other[p.problem]) for p in cell.problems if p.problem in other]
        pairs += len(both)
        wins += sum(mine and not its for mine, its in both)
        losses += sum(its and not mine for mine, its in both)
        if both:
            differences.append(
                100 * (sum(m for m, _ in both) - sum(i for _, i in both)) / len(both)
            )
    one, two = first[0].cell, second[0].cell
    return PairedComparison(
        one.method,
        two.method,
        one.domain,
        one.noise,
        pairs,
        wins,
        losses,
        Spread.of(differences),
        mcnemar(wins, losses) if testable else None,
    )


def mcnemar(wins: int, losses: int) -> float:
    """Exact two-sided p-value that wins and losses are equally likely."""
    total = wins + losses
    tail = sum(math.comb(total, k) for k in range(min(wins, losses) + 1))
    return float(min(1.0, 2 * tail / 2**total))

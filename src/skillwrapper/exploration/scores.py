"""Scores of skill sequences: balance, coverage, and what is best by both (paper, Section 3.1)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.grounding.simulation import simulate
from skillwrapper.world.skills import SkillInstance


def balance(
    model: GroundModel, start: Labels, sequence: Sequence[SkillInstance], target: float
) -> float:
    """Balance: how close the predicted share of successes is to the wanted one (Algorithm 4).

    ``-|r - r*|``, the larger the better; r is the share of skills predicted to succeed.

    Args:
        model: the learned operators.
        start: abstract state (atoms,) in which the sequence starts.
        sequence: skill instances, not empty.
        target: the wanted share (the paper's r*).
    """
    return -abs(predicted_success_ratio(model, start, sequence) - target)


def predicted_success_ratio(
    model: GroundModel, start: Labels, sequence: Sequence[SkillInstance]
) -> float:
    """Share of the skills that the model predicts to succeed; a failure changes nothing."""
    return float(simulate(model, start, sequence).succeeds.mean())


class PairCounts:
    """Coverage: how evenly pairs of consecutive skills were tried (Algorithm 3; the paper's Q).

    Args:
        instances: all skill instances.
        lifted: count pairs of skills instead of pairs of skill instances.
    """

    def __init__(self, instances: Sequence[SkillInstance], *, lifted: bool = False) -> None:
        keys = sorted({i.skill for i in instances}) if lifted else instances
        self._index: dict[object, int] = {key: number for number, key in enumerate(keys)}
        self._lifted = lifted
        self.counts: NDArray[np.int64] = np.zeros((len(keys), len(keys)), dtype=np.int64)

    def add(self, sequence: Iterable[SkillInstance]) -> None:
        """Count the consecutive pairs of an executed sequence."""
        self.counts += self._count(sequence)

    def gain(self, sequence: Iterable[SkillInstance]) -> float:
        """Entropy gained by executing a sequence, in nats: H(Q') - H(Q)."""
        return entropy(self.counts + self._count(sequence)) - entropy(self.counts)

    def share_covered(self) -> float:
        """Share of pairs that were tried at least once, 0 to 1."""
        return float((self.counts > 0).mean()) if self.counts.size else 1.0

    def _count(self, sequence: Iterable[SkillInstance]) -> NDArray[np.int64]:
        counts = np.zeros_like(self.counts)
        for first, second in pairwise(sequence):
            counts[self._place(first, second)] += 1
        return counts

    def _place(self, first: SkillInstance, second: SkillInstance) -> tuple[int, int]:
        if self._lifted:
            return self._index[first.skill], self._index[second.skill]
        return self._index[first], self._index[second]


def entropy(counts: NDArray[np.int64]) -> float:
    """Shannon entropy of the distribution that counts induce, in nats; 0 without counts."""
    total = counts.sum()
    if total == 0:
        return 0.0
    shares = counts[counts > 0] / total
    return float(-(shares * np.log(shares)).sum())


def pareto_set(scores: Sequence[tuple[float, ...]]) -> tuple[int, ...]:
    """Indices of candidates that no other one beats; exact ties all stay (docs/semantics.md D16).

    One beats another if it is at least as good in every score and better in one.
    """
    return tuple(
        i for i, own in enumerate(scores) if not any(_beats(other, own) for other in scores)
    )


def _beats(first: tuple[float, ...], second: tuple[float, ...]) -> bool:
    return first != second and all(a >= b for a, b in zip(first, second, strict=True))

"""Clopper-Pearson: an interval that holds the true share with at least the wanted probability."""

from __future__ import annotations

import math
from collections.abc import Callable

_HALVINGS = 60


def clopper_pearson(wrong: int, tried: int, confidence: float = 0.95) -> tuple[float, float]:
    """The exact interval of a share, from independent tries.

    Args:
        wrong: how many were wrong.
        tried: of how many, at least 1.
        confidence: above 0 and below 1.
    """
    tail = (1 - confidence) / 2
    lower, upper = 0.0, 1.0
    if wrong > 0:
        lower = _where(lambda share: at_most(wrong - 1, tried, share) > 1 - tail)
    if wrong < tried:
        upper = _where(lambda share: at_most(wrong, tried, share) > tail)
    return lower, upper


def at_most(count: int, tried: int, share: float) -> float:
    """The probability of at most so many of a binomial distribution."""
    if share <= 0 or count >= tried:
        return 1.0
    if share >= 1:
        return 0.0
    first, second = math.log(share), math.log1p(-share)
    whole = math.lgamma(tried + 1)
    return math.fsum(
        math.exp(
            whole
            - math.lgamma(k + 1)
            - math.lgamma(tried - k + 1)
            + k * first
            + (tried - k) * second
        )
        for k in range(count + 1)
    )


def _where(holds: Callable[[float], bool]) -> float:
    """Up to where something holds that holds at 0 and not at 1."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return (low + high) / 2

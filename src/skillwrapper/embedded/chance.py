"""Seeded chance: draws that depend on what was asked and on nothing else."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TypeVar

Item = TypeVar("Item")

_STEPS = 1 << 53


class Chance:
    """A stream of draws; equal parts give equal streams, on every machine and Python version.

    Args:
        *parts: what the draws depend on.
    """

    def __init__(self, *parts: str | int) -> None:
        joined = "\x1f".join(map(str, parts))
        self._state = hashlib.sha256(joined.encode("utf-8", "surrogatepass")).digest()

    def number(self) -> float:
        """The next number, 0 or more and below 1."""
        value = int.from_bytes(self._state[:8], "big") >> 11
        self._state = hashlib.sha256(self._state).digest()
        return value / _STEPS

    def happens(self, share: float) -> bool:
        """True in a share of cases."""
        return self.number() < share

    def below(self, limit: int) -> int:
        """A whole number from 0 to ``limit`` - 1."""
        return min(int(self.number() * limit), limit - 1)

    def pick(self, items: Sequence[Item]) -> Item:
        """One of the items, all equally likely."""
        return items[self.below(len(items))]

    def pick_weighted(self, items: Sequence[Item], weights: Sequence[float]) -> Item:
        """One of the items; likelier the greater its weight (0 or more, not all 0)."""
        mark = self.number() * sum(weights)
        for item, weight in zip(items, weights, strict=True):
            mark -= weight
            if mark < 0:
                return item
        return items[-1]

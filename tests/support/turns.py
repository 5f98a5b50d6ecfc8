"""Trying many things with many others, without trying all with all."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import Any


def in_turn(*kinds: Sequence[Any]) -> Iterator[tuple[Any, ...]]:
    """One of each kind together, until everything had its turn; nothing if a kind is empty."""
    turns = max(map(len, kinds)) if all(kinds) else 0
    return itertools.islice(zip(*map(itertools.cycle, kinds), strict=False), turns)

"""Remembering what short lines mean: in the replies of a run most of them come again."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import lru_cache
from typing import TypeVar

_MOST = 8192
_LONGEST = 300

Text = TypeVar("Text", bound=Hashable)
Result = TypeVar("Result")


def remembering(
    read: Callable[[Text], Result], length: Callable[[Text], int]
) -> Callable[[Text], Result]:
    """A function of a line that remembers its results, but none for long lines.

    Args:
        read: gives the same, unchangeable result for the same line.
        length: how many characters a line has.
    """
    known = lru_cache(maxsize=_MOST)(read)
    return lambda line: known(line) if length(line) <= _LONGEST else read(line)

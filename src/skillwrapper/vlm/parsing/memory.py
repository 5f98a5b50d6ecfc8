"""Remembering what short lines mean: in the replies of a run most of them come again."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TypeVar

_MOST = 8192
_LONGEST = 300

Text = TypeVar("Text", bound=Hashable)
Result = TypeVar("Result")


class _Memory(dict[Text, Result]):
    """What lines mean; looking up one that is known takes no step of Python."""

    def __init__(self, read: Callable[[Text], Result], length: Callable[[Text], int]) -> None:
        super().__init__()
        self._read = read
        self._length = length

    def __missing__(self, line: Text) -> Result:
        result = self._read(line)
        if self._length(line) <= _LONGEST:
            if len(self) >= _MOST:
                self.clear()
            self[line] = result
        return result


def remembering(
    read: Callable[[Text], Result], length: Callable[[Text], int]
) -> Callable[[Text], Result]:
    """A function of a line that remembers its results, but none for long lines.

    Args:
        read: gives the same, unchangeable result for the same line.
        length: how many characters a line has.
    """
    return _Memory(read, length).__getitem__

"""Finding a known name in what a model wrote: other case, other separators, small typos."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

_ARTICLE = re.compile(r"^(?:the|an?)\s+", re.IGNORECASE)
_DIGITS = re.compile(r"\d+")
_LONGEST_NAME = 60
_SIMILAR = 0.8
_LEAD = 0.08


def fold(name: str) -> str:
    """A name without case and separators: ``Top_Bun`` and ``top bun`` are one."""
    return "".join(c for c in name.casefold() if c.isalnum())


class NameIndex:
    """Looks up names; remembers what it found, so that parsing a long reply stays linear.

    Args:
        names: the names that exist.
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._names = tuple(dict.fromkeys(names))
        self._folded: dict[str, list[str]] = {}
        for name in self._names:
            self._folded.setdefault(fold(name), []).append(name)
        self._found: dict[str, str | None] = {name: name for name in self._names}

    def find(self, written: str) -> str | None:
        """The name that was meant; None if there is none, or more than one comes near."""
        if written not in self._found:
            self._found[written] = self._search(written)
        return self._found[written]

    def _search(self, written: str) -> str | None:
        given = fold(_ARTICLE.sub("", written.strip()))
        if not given or len(given) > _LONGEST_NAME:
            return None
        for attempt in (given, given.rstrip("0123456789")):
            same = self._folded.get(attempt, [])
            if same:
                return same[0] if len(same) == 1 else None
        return self._nearest(given)

    def _nearest(self, given: str) -> str | None:
        digits = _DIGITS.findall(given)
        scores = sorted(
            (
                (difflib.SequenceMatcher(None, given, known, autojunk=False).ratio(), known)
                for known in self._folded
                if _DIGITS.findall(known) == digits
            ),
            reverse=True,
        )
        if not scores or scores[0][0] < _SIMILAR:
            return None
        if len(scores) > 1 and scores[1][0] > scores[0][0] - _LEAD:
            return None
        same = self._folded[scores[0][1]]
        return same[0] if len(same) == 1 else None

"""Finding a known name in what a model wrote: other case, other separators, small typos."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence

from skillwrapper.vlm.parsing.memory import remembering

_ARTICLE = re.compile(r"(?:the|an?) ", re.IGNORECASE)
_DIGITS = re.compile(r"\d")
_LONGEST_NAME = 60
_SIMILAR = 0.8
_LEAD = 0.08
_MOST_REMEMBERED = 4096


def _fold(name: str) -> str:
    """A name without case and separators: ``Top_Bun`` and ``top bun`` are one."""
    return "".join(filter(str.isalnum, name.casefold()))


fold = remembering(_fold, len)


def words_of(text: str) -> tuple[str, ...]:
    """The words of a text: a long list of words is easier to read as one."""
    return tuple(text.split())


class NameIndex:
    """Looks up names; remembers what it found.

    Args:
        names: the names that exist.
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._names = tuple(dict.fromkeys(names))
        self._folded: dict[str, list[str]] = {}
        for name in self._names:
            self._folded.setdefault(fold(name), []).append(name)
        self._found: dict[str, str | None] = {name: name for name in self._names}
        self._letters = {name: _letters(name) for name in self._folded}

    def find(self, written: str) -> str | None:
        """The name that was meant; None if there is none, or more than one comes near."""
        if written in self._found:
            return self._found[written]
        found = self._search(written)
        if len(self._found) < _MOST_REMEMBERED:
            self._found[written] = found
        return found

    def find_exact(self, written: str) -> str | None:
        """The only name that differs in case, separators, article and index at most."""
        given = fold(_ARTICLE.sub("", written[: 2 * _LONGEST_NAME].strip(), count=1))
        for attempt in (given, given.rstrip("0123456789")):
            same = self._folded.get(attempt, []) if attempt else []
            if same:
                return same[0] if len(same) == 1 else None
        return None

    def find_among(self, readings: Sequence[str]) -> str | None:
        """The one name that any of several readings means; those without a slip count first."""
        for find in (self.find_exact, self.find):
            found = {name for reading in readings if (name := find(reading)) is not None}
            if found:
                return found.pop() if len(found) == 1 else None
        return None

    def _search(self, written: str) -> str | None:
        exact = self.find_exact(written)
        given = fold(_ARTICLE.sub("", written[: 2 * _LONGEST_NAME].strip(), count=1))
        if exact is not None or not given or len(given) > _LONGEST_NAME:
            return exact
        if given in self._folded or given.rstrip("0123456789") in self._folded:
            return None
        return self._nearest(given)

    def _nearest(self, given: str) -> str | None:
        digits = _DIGITS.findall(given)
        letters = _letters(given)
        compare = difflib.SequenceMatcher(None, b=given, autojunk=False)
        scores = []
        for known in self._folded:
            # Comparing is slow: first what it can be at most, by the letters that only one has.
            others = (letters & ~self._letters[known]).bit_count()
            lacking = (self._letters[known] & ~letters).bit_count()
            common = min(len(given) - others, len(known) - lacking)
            at_most = 2 * common / (len(given) + len(known))
            if at_most >= _SIMILAR - _LEAD and _DIGITS.findall(known) == digits:
                compare.set_seq1(known)
                scores.append((compare.ratio(), known))
        scores.sort(reverse=True)
        if not scores or scores[0][0] < _SIMILAR:
            return None
        if len(scores) > 1 and scores[1][0] > scores[0][0] - _LEAD:
            return None
        same = self._folded[scores[0][1]]
        return same[0] if len(same) == 1 else None


def _letters(name: str) -> int:
    """Which letters a name has, as bits; some share one."""
    bits = 0
    for letter in set(name):
        bits |= 1 << ord(letter) % 61
    return bits

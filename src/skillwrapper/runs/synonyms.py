"""Predicates of two runs that say the same, or the opposite, of pictures that both have read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillwrapper.runs.archive.archive import ArchivedIteration
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.symbols import Predicate

_LEAST = 6
"""Labels that must be known in both, true and false ones among them."""


@dataclass(frozen=True)
class Synonym:
    """Two predicates that go together on all pictures that both runs have read.

    Attributes:
        first: of the first run.
        second: of the second run.
        same: whether they are true of the same; else one is true where the other is false.
        labels: on so many labels.
    """

    first: Predicate
    second: Predicate
    same: bool
    labels: int

    def __str__(self) -> str:
        how = "the same as" if self.same else "the opposite of"
        return f"{self.second.signature} is {how} {self.first.signature} in {self.labels} labels"


def find_synonyms(one: ArchivedIteration, other: ArchivedIteration) -> tuple[Synonym, ...]:
    """Pairs of predicates that are not known to both runs, each predicate once."""
    ours = [p for p in one.model.predicates if p not in other.model.predicates]
    theirs = [p for p in other.model.predicates if p not in one.model.predicates]
    found = []
    for first in ours:
        pairs = (_compare(first, second, one.labels, other.labels) for second in theirs)
        synonym = next((pair for pair in pairs if pair is not None), None)
        if synonym is not None:
            theirs.remove(synonym.second)
            found.append(synonym)
    return tuple(found)


def _compare(
    first: Predicate, second: Predicate, ours: RecordedLabels, theirs: RecordedLabels
) -> Synonym | None:
    if first.types != second.types:
        return None
    pairs = list(_labels(first.name, second.name, ours, theirs))
    values = {one for one, _ in pairs}
    agreements = {one == other for one, other in pairs}
    if len(pairs) < _LEAST or len(values) < 2 or len(agreements) > 1:
        return None
    return Synonym(first, second, agreements.pop(), len(pairs))


def _labels(
    first: str, second: str, ours: RecordedLabels, theirs: RecordedLabels
) -> Iterator[tuple[bool, bool]]:
    """What both say of each grounding in each picture, where both know it."""
    for key, row in ours.rows.items():
        other = theirs.of(key)
        for atom, value in row.items():
            name, _, terms = atom.partition("(")
            partner = other.get(f"{second}({terms}") if name == first else None
            if value is not None and partner is not None:
                yield value, partner

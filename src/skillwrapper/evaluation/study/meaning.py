"""Whether two predicates mean the same, or the opposite, decided by their truth in many states."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from enum import StrEnum

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, Labels
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.types import Object

Columns = Mapping[tuple[str, ...], Labels]
"""For every tuple of objects the labels over all states (states,)."""


class Meaning(StrEnum):
    """What a proposed predicate is to the target."""

    SYNONYM = "synonym"
    ANTONYM = "antonym"
    OTHER = "other"
    UNDECIDED = "undecided"

    @property
    def is_correct(self) -> bool:
        """The paper counts synonyms and antonyms as correct."""
        return self in (Meaning.SYNONYM, Meaning.ANTONYM)


def target_columns(target: Atom, columns: Columns) -> Columns:
    """The labels of a target atom by the objects that stand for its open terms, in order."""
    open_terms = [i for i, term in enumerate(target.terms) if term.startswith("?")]
    return {
        tuple(objects[i] for i in open_terms): labels
        for objects, labels in columns.items()
        if all(t.startswith("?") or t == o for t, o in zip(target.terms, objects, strict=True))
    }


def compare_meaning(
    proposed: Predicate, proposed_columns: Columns, target: Columns, objects: Sequence[Object]
) -> Meaning:
    """Compare truth over all states, for the best way of matching the parameters.

    A parameter of which only one object can stand there says nothing and may be left out on
    either side, as the paper leaves out the robot. Compared are the objects of which both speak.
    """
    if all((labels == UNKNOWN).all() for labels in proposed_columns.values()):
        return Meaning.UNDECIDED
    verdicts = {
        _compare(proposed_columns, target, places)
        for places in _matchings(proposed, target, objects)
    }
    order = (Meaning.SYNONYM, Meaning.ANTONYM, Meaning.UNDECIDED)
    return next((verdict for verdict in order if verdict in verdicts), Meaning.OTHER)


def _matchings(
    proposed: Predicate, target: Columns, objects: Sequence[Object]
) -> Iterator[tuple[int | None, ...]]:
    """For every parameter of the proposed predicate its place in the target, or None."""
    arity = len(next(iter(target), ()))
    ranges = [{names[i] for names in target} for i in range(arity)]
    single = [sum(t in o.types for o in objects) == 1 for t in proposed.types]
    options: list[int | None] = [*range(arity), None]
    for places in itertools.product(options, repeat=proposed.arity):
        used = [place for place in places if place is not None]
        left_out = [s for place, s in zip(places, single, strict=True) if place is None]
        unmatched = [len(ranges[i]) == 1 for i in range(arity) if i not in used]
        if len(set(used)) == len(used) and all(left_out) and all(unmatched):
            yield places


def _compare(proposed: Columns, target: Columns, places: tuple[int | None, ...]) -> Meaning:
    pairs = [
        (labels, wanted)
        for names, labels in proposed.items()
        for slots, wanted in target.items()
        if all(p is None or slots[p] == name for p, name in zip(places, names, strict=True))
    ]
    if not any({TRUE, FALSE} <= set(np.unique(wanted)) for _, wanted in pairs):
        return Meaning.OTHER  # nothing that could tell an equal one from a constant
    known = [(labels[labels != UNKNOWN], wanted[labels != UNKNOWN]) for labels, wanted in pairs]
    complete = all(
        len(labels) == len(both) for (labels, _), (both, _) in zip(pairs, known, strict=True)
    )
    if all((labels == wanted).all() for labels, wanted in known):
        return Meaning.SYNONYM if complete else Meaning.UNDECIDED
    if all((labels != wanted).all() for labels, wanted in known):
        return Meaning.ANTONYM if complete else Meaning.UNDECIDED
    return Meaning.OTHER

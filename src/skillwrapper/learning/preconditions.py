"""Preconditions of a cluster: what held before every one of its transitions.

Three kinds of evidence (D2, D10):

* plain literals over the operator's parameters: seen to hold at least once, never seen not to;
* universal absence: no other object ever stood in the relation to a parameter;
* existential context: in every transition some other object stood in the relation.

A literal must speak of an argument of the skill, or of one context object alone (the paper's
restriction, Section 3.3); literals between context objects, absences and existential context
around them are added only on demand (D5).
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE, TRUE
from skillwrapper.grounding.atom_index import ANY, LiftedAtom
from skillwrapper.learning.clusters import Bundle, bundle_groups
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.tables import NO_LABEL, Group

_Witnesses = list[NDArray[np.bool_]]
"""For every table the objects of the scene (rows, objects) that an existential context may be."""


@dataclass(frozen=True)
class ExistentialContext:
    """Some other object that stood in relations in every transition.

    Attributes:
        patterns: the relations, ``ANY`` at the place of the object.
        types: the most specific types of which such an object was always there; closed upwards.
    """

    patterns: tuple[LiftedAtom, ...]
    types: frozenset[str]


@dataclass(frozen=True)
class Evidence:
    """What held before every transition of a cluster.

    Attributes:
        literals: (pattern, truth) over the parameters.
        absences: patterns in which no other object ever stood.
        existentials: context objects that were always there.
    """

    literals: tuple[tuple[LiftedAtom, bool], ...]
    absences: tuple[LiftedAtom, ...]
    existentials: tuple[ExistentialContext, ...]


def gather_evidence(
    groups: Sequence[Group], language: OperatorLanguage, *, between_context: bool = False
) -> Evidence:
    """What held before every transition of the groups of one cluster.

    Args:
        groups: groups of one cluster, at least one.
        language: what may be said of it.
        between_context: also literals between context objects, and what other objects stand in
            relations to them (D5).
    """
    predicates, arity, settings = language.predicates, language.arity, language.settings
    bundles = tuple(bundle_groups(groups))
    size = len(groups[0].lifting.objects)
    plain = tuple(_plain_patterns(predicates, arity, size, between_context))
    patterns = tuple(_open_patterns(predicates, size if between_context else arity))
    relations = [_Relations.of(bundle, patterns, size) for bundle in bundles]
    absent = _never(relations) if settings.absences else []
    return Evidence(
        _common_literals(bundles, plain, size),
        tuple(patterns[i] for i in absent),
        _merge_existentials(bundles, patterns, relations, settings.existential_context),
    )


def _plain_patterns(
    predicates: Sequence[Predicate], arity: int, size: int, between_context: bool
) -> Iterator[LiftedAtom]:
    for predicate in predicates:
        for terms in itertools.permutations(range(size), predicate.arity):
            if between_context or len(terms) <= 1 or min(terms) < arity:
                yield predicate.name, terms


def _open_patterns(predicates: Sequence[Predicate], arity: int) -> Iterator[LiftedAtom]:
    for predicate in predicates:
        if predicate.arity < 2:
            continue
        for place in range(predicate.arity):
            for terms in itertools.permutations(range(arity), predicate.arity - 1):
                yield predicate.name, (*terms[:place], ANY, *terms[place:])


def _common_literals(
    bundles: Sequence[Bundle], patterns: Sequence[LiftedAtom], size: int
) -> tuple[tuple[LiftedAtom, bool], ...]:
    seen_true = np.zeros(len(patterns), dtype=bool)
    seen_false = np.zeros(len(patterns), dtype=bool)
    everywhere = np.ones(len(patterns), dtype=bool)
    for bundle in bundles:
        index = bundle.table.space.index
        columns = index.columns(index.patterns(patterns, size), bundle.bindings)
        everywhere &= (columns >= 0).all(axis=0)
        values = bundle.labels(columns)
        seen_true |= (values == TRUE).any(axis=0)
        seen_false |= (values == FALSE).any(axis=0)
    decided = everywhere & (seen_true ^ seen_false)
    return tuple((patterns[i], bool(seen_true[i])) for i in np.flatnonzero(decided).tolist())


@dataclass(frozen=True, eq=False)
class _Relations:
    """Which other objects stood in the relations of open patterns, in one table.

    Attributes:
        witnesses: (rows, patterns, objects) whether the object stood in the relation.
        always: (patterns,) whether in every transition some object did.
        never: (patterns,) whether in no transition any object did.
        seen_none: (patterns,) whether in some transition surely no object did.
    """

    witnesses: NDArray[np.bool_]
    always: NDArray[np.bool_]
    never: NDArray[np.bool_]
    seen_none: NDArray[np.bool_]

    @classmethod
    def of(cls, bundle: Bundle, patterns: Sequence[LiftedAtom], size: int) -> _Relations:
        index = bundle.table.space.index
        columns = index.open_columns(index.patterns(patterns, size), bundle.bindings)
        columns = np.where(bundle.taken[:, np.newaxis, :], -1, columns)
        values = bundle.labels(columns)
        witnesses = values == TRUE
        witnessed = witnesses.any(axis=2)
        none = ((values == FALSE) | (values == NO_LABEL)).all(axis=2)
        grounded = np.any(columns >= 0, axis=2)
        none &= grounded[bundle.group]
        return cls(witnesses, witnessed.all(axis=0), ~witnessed.any(axis=0), none.any(axis=0))


def _never(relations: Sequence[_Relations]) -> list[int]:
    """The patterns in which no other object ever stood, seen at least once to hold for none."""
    never = np.logical_and.reduce([r.never for r in relations])
    seen = np.logical_or.reduce([r.seen_none for r in relations])
    return [int(i) for i in np.flatnonzero(never & seen)]


def _merge_existentials(
    bundles: Sequence[Bundle],
    patterns: Sequence[LiftedAtom],
    relations: Sequence[_Relations],
    most: int,
) -> tuple[ExistentialContext, ...]:
    """One context object for all patterns that one object can always meet together.

    Different context objects must be different (D4): a pattern for which no object of its own
    is always there is left out. So is one that would take more objects than are allowed: before
    a single transition everything in sight was always there.
    """
    merged: list[list[LiftedAtom]] = []
    contexts: list[_Witnesses] = []
    for place in np.flatnonzero(np.logical_and.reduce([r.always for r in relations])).tolist():
        own = [r.witnesses[:, place] for r in relations]
        for number, known in enumerate(contexts):
            both = [a & b for a, b in zip(known, own, strict=True)]
            if _distinct(both, _without(contexts, number)):
                merged[number].append(patterns[place])
                contexts[number] = both
                break
        else:
            if len(contexts) < most and _distinct(own, contexts):
                merged.append([patterns[place]])
                contexts.append(own)
    found = []
    for number, known_patterns in enumerate(merged):
        types, contexts[number] = _common_types(bundles, contexts, number)
        found.append(ExistentialContext(tuple(known_patterns), types))
    return tuple(found)


def _distinct(own: _Witnesses, others: Sequence[_Witnesses]) -> bool:
    """Whether in every transition each context can have an object for itself.

    Hall's condition: any number of contexts have together at least as many witnesses. It is
    known to hold among the others.
    """
    for size in range(len(others) + 1):
        for chosen in itertools.combinations(others, size):
            for found in zip(own, *chosen, strict=True):
                together = np.logical_or.reduce(found)
                if (together.sum(axis=1) <= size).any():
                    return False
    return True


def _without(contexts: Sequence[_Witnesses], number: int) -> list[_Witnesses]:
    return [known for place, known in enumerate(contexts) if place != number]


def _common_types(
    bundles: Sequence[Bundle], contexts: Sequence[_Witnesses], number: int
) -> tuple[frozenset[str], _Witnesses]:
    """Types of which, in every transition, some witness of a context was; and those witnesses."""
    others = _without(contexts, number)
    frequency: Counter[str] = Counter()
    for bundle in bundles:
        for thing in bundle.table.space.objects:
            frequency.update(dict.fromkeys(thing.types, len(bundle.bindings)))
    chosen: frozenset[str] = frozenset()
    fitting = contexts[number]
    ever = [found.any(axis=0) for found in fitting]
    for name in sorted(frequency, key=lambda t: (frequency[t], t)):  # rarest: they say most
        of_type = [bundle.table.space.index.of_types([name]) for bundle in bundles]
        if all(of[seen].all() for of, seen in zip(of_type, ever, strict=True)):
            chosen |= {name}  # nothing to tell: all witnesses are of the type
        elif all(of[seen].any() for of, seen in zip(of_type, ever, strict=True)):
            fewer = [found & of for found, of in zip(fitting, of_type, strict=True)]
            if _distinct(fewer, others):
                chosen, fitting = chosen | {name}, fewer
                ever = [found.any(axis=0) for found in fitting]
    return chosen, fitting

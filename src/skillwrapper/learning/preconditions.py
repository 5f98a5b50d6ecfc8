"""Preconditions of a cluster: what held before every one of its transitions.

Three kinds of evidence (DESIGN.md D2, D10):

* plain literals over the operator's parameters: seen to hold at least once, never seen not to;
* universal absence: no other object ever stood in the relation to a parameter;
* existential context: in every transition some other object stood in the relation.

A literal must speak of an argument of the skill, or of one context object alone (the paper's
restriction, Section 3.3); literals between context objects are added only on demand (D5).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from skillwrapper.learning.clusters import Group
from skillwrapper.symbols import FALSE, TRUE, Atom, AtomSpace, Predicate

OTHER = -1
"""The position of the quantified object in a pattern."""

Pattern = tuple[str, tuple[int, ...]]
"""A predicate with the positions of its terms; at most one of them is ``OTHER``."""


@dataclass(frozen=True)
class ExistentialContext:
    """Some other object that stood in relations in every transition.

    Attributes:
        patterns: the relations, ``OTHER`` at the place of the object.
        types: the most specific types of which such an object was always there; closed upwards.
    """

    patterns: tuple[Pattern, ...]
    types: frozenset[str]


@dataclass(frozen=True)
class Evidence:
    """What held before every transition of a cluster.

    Attributes:
        literals: (pattern, truth) over the parameters.
        absences: patterns in which no other object ever stood.
        existentials: context objects that were always there.
    """

    literals: tuple[tuple[Pattern, bool], ...]
    absences: tuple[Pattern, ...]
    existentials: tuple[ExistentialContext, ...]


def gather_evidence(
    groups: Sequence[Group],
    predicates: Sequence[Predicate],
    arity: int,
    *,
    between_context: bool = False,
) -> Evidence:
    """What held before every transition of the groups of one cluster.

    Args:
        groups: groups of one cluster, at least one.
        predicates: the vocabulary without tautologies.
        arity: number of arguments of the skill.
        between_context: also literals between context objects (DESIGN.md D5).
    """
    size = len(groups[0].lifting.objects)
    literals = _common_literals(
        groups, tuple(_plain_patterns(predicates, arity, size, between_context))
    )
    absences: list[Pattern] = []
    witnessed: list[Pattern] = []
    for pattern in _open_patterns(predicates, arity):
        verdict = _judge_open(groups, pattern)
        if verdict is False:
            absences.append(pattern)
        elif verdict is True:
            witnessed.append(pattern)
    return Evidence(literals, tuple(absences), _merge_existentials(groups, witnessed))


def _plain_patterns(
    predicates: Sequence[Predicate], arity: int, size: int, between_context: bool
) -> Iterator[Pattern]:
    for predicate in predicates:
        for terms in itertools.permutations(range(size), predicate.arity):
            if between_context or len(terms) <= 1 or min(terms) < arity:
                yield predicate.name, terms


def _open_patterns(predicates: Sequence[Predicate], arity: int) -> Iterator[Pattern]:
    for predicate in predicates:
        if predicate.arity < 2:
            continue
        for place in range(predicate.arity):
            for terms in itertools.permutations(range(arity), predicate.arity - 1):
                yield predicate.name, (*terms[:place], OTHER, *terms[place:])


def _common_literals(
    groups: Sequence[Group], patterns: tuple[Pattern, ...]
) -> tuple[tuple[Pattern, bool], ...]:
    seen_true = np.zeros(len(patterns), dtype=bool)
    seen_false = np.zeros(len(patterns), dtype=bool)
    everywhere = np.ones(len(patterns), dtype=bool)
    for group in groups:
        columns = _pattern_columns(group.table.space, group.lifting.objects, patterns)
        present = columns >= 0
        everywhere &= present
        values = group.before[:, columns[present]]
        seen_true[present] |= (values == TRUE).any(axis=0)
        seen_false[present] |= (values == FALSE).any(axis=0)
    decided = everywhere & (seen_true ^ seen_false)
    return tuple((patterns[i], bool(seen_true[i])) for i in np.flatnonzero(decided))


@lru_cache(maxsize=65536)
def _pattern_columns(
    space: AtomSpace, objects: tuple[str, ...], patterns: tuple[Pattern, ...]
) -> NDArray[np.intp]:
    """Columns of the patterns under a binding; -1 where it is no grounding (wrong types)."""
    return np.array(
        [
            space.column.get(Atom(name, tuple(objects[t] for t in terms)), -1)
            for name, terms in patterns
        ],
        dtype=np.intp,
    )


@lru_cache(maxsize=65536)
def _open_columns(
    space: AtomSpace, objects: tuple[str, ...], pattern: Pattern
) -> tuple[tuple[int, int], ...]:
    """(index of the other object in the scene, column) of the groundings of an open pattern."""
    name, terms = pattern
    found = []
    for number, other in enumerate(space.objects):
        if other.name in objects:
            continue
        atom = Atom(name, tuple(other.name if t == OTHER else objects[t] for t in terms))
        if atom in space.column:
            found.append((number, space.column[atom]))
    return tuple(found)


def _judge_open(groups: Sequence[Group], pattern: Pattern) -> bool | None:
    """True: always some other object; False: never one (seen at least once); None: neither."""
    always = never = True
    seen_none = False
    for group in groups:
        columns = [c for _, c in _open_columns(group.table.space, group.lifting.objects, pattern)]
        values = group.before[:, columns]
        witnessed = (values == TRUE).any(axis=1)
        always &= bool(witnessed.all())
        never &= not witnessed.any()
        seen_none |= bool(columns) and bool((values == FALSE).all(axis=1).any())
        if not always and not never:
            return None
    if always:
        return True
    return False if seen_none else None


def _merge_existentials(
    groups: Sequence[Group], patterns: Sequence[Pattern]
) -> tuple[ExistentialContext, ...]:
    """One context object for all patterns that one object can always meet together.

    Different context objects must be different (D4): a pattern for which no separate witness
    is always there is left out.
    """
    merged: list[tuple[list[Pattern], list[NDArray[np.bool_]]]] = []
    for pattern in patterns:
        witnesses = [_witnesses(group, pattern) for group in groups]
        for known, common in merged:
            both = [a & b for a, b in zip(common, witnesses, strict=True)]
            if all(w.any(axis=1).all() for w in both):
                known.append(pattern)
                common[:] = both
                break
        else:
            if _separate([c for _, c in merged], witnesses):
                merged.append(([pattern], witnesses))
    return tuple(
        ExistentialContext(tuple(known), _common_types(groups, witnesses))
        for known, witnesses in merged
    )


def _witnesses(group: Group, pattern: Pattern) -> NDArray[np.bool_]:
    """Which objects of the scene stood in the relation (rows, objects)."""
    found = np.zeros((len(group.rows), len(group.table.space.objects)), dtype=bool)
    before = group.before
    for number, column in _open_columns(group.table.space, group.lifting.objects, pattern):
        found[:, number] = before[:, column] == TRUE
    return found


def _separate(
    earlier: Sequence[Sequence[NDArray[np.bool_]]], witnesses: Sequence[NDArray[np.bool_]]
) -> bool:
    """Whether in every transition some witness is not the only witness of an earlier context."""
    for number, own in enumerate(witnesses):
        taken = np.zeros_like(own)
        for other in earlier:
            single = other[number].sum(axis=1, keepdims=True) == 1
            taken |= other[number] & single
        if not (own & ~taken).any(axis=1).all():
            return False
    return True


def _common_types(
    groups: Sequence[Group], witnesses: Sequence[NDArray[np.bool_]]
) -> frozenset[str]:
    """Types of which, in every transition, some witness was; jointly if there are several."""
    candidates = {t for g in groups for o in g.table.space.objects for t in o.types}
    always = sorted(
        (t for t in candidates if _always_of(groups, witnesses, (t,))),
        key=lambda t: (_frequency(groups, t), t),
    )
    chosen: list[str] = []
    for name in always:  # rarest first: they say most
        if _always_of(groups, witnesses, (*chosen, name)):
            chosen.append(name)
    return frozenset(chosen)


def _always_of(
    groups: Sequence[Group], witnesses: Sequence[NDArray[np.bool_]], types: tuple[str, ...]
) -> bool:
    for group, found in zip(groups, witnesses, strict=True):
        fits = np.array([o.has_types(types) for o in group.table.space.objects])
        if not found[:, fits].any(axis=1).all():
            return False
    return True


def _frequency(groups: Sequence[Group], type_name: str) -> int:
    return sum(type_name in o.types for g in groups for o in g.table.space.objects)

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

_Witnesses = list[NDArray[np.bool_]]
"""For every group the objects of the scene (rows, objects) that an existential context may be."""


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
    absences: bool = True,
) -> Evidence:
    """What held before every transition of the groups of one cluster.

    Args:
        groups: groups of one cluster, at least one.
        predicates: the vocabulary without tautologies.
        arity: number of arguments of the skill.
        between_context: also literals between context objects (DESIGN.md D5).
        absences: whether universal absences are looked for (DESIGN.md D2).
    """
    size = len(groups[0].lifting.objects)
    literals = _common_literals(
        groups, tuple(_plain_patterns(predicates, arity, size, between_context))
    )
    absent: list[Pattern] = []
    witnessed: list[Pattern] = []
    for pattern in _open_patterns(predicates, arity):
        verdict = _judge_open(groups, pattern)
        if verdict is False and absences:
            absent.append(pattern)
        elif verdict is True:
            witnessed.append(pattern)
    return Evidence(literals, tuple(absent), _merge_existentials(groups, witnessed))


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

    Different context objects must be different (D4): a pattern for which no object of its own
    is always there is left out.
    """
    merged: list[list[Pattern]] = []
    contexts: list[_Witnesses] = []
    for pattern in patterns:
        own = [_witnesses(group, pattern) for group in groups]
        for number, known in enumerate(contexts):
            both = [a & b for a, b in zip(known, own, strict=True)]
            if _distinct(both, _without(contexts, number)):
                merged[number].append(pattern)
                contexts[number] = both
                break
        else:
            if _distinct(own, contexts):
                merged.append([pattern])
                contexts.append(own)
    found = []
    for number, known_patterns in enumerate(merged):
        types, contexts[number] = _common_types(groups, contexts, number)
        found.append(ExistentialContext(tuple(known_patterns), types))
    return tuple(found)


def _witnesses(group: Group, pattern: Pattern) -> NDArray[np.bool_]:
    """Which objects of the scene stood in the relation (rows, objects)."""
    found = np.zeros((len(group.rows), len(group.table.space.objects)), dtype=bool)
    before = group.before
    for number, column in _open_columns(group.table.space, group.lifting.objects, pattern):
        found[:, number] = before[:, column] == TRUE
    return found


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
    groups: Sequence[Group], contexts: Sequence[_Witnesses], number: int
) -> tuple[frozenset[str], _Witnesses]:
    """Types of which, in every transition, some witness of a context was; and those witnesses."""
    others = _without(contexts, number)
    names = {t for g in groups for o in g.table.space.objects for t in o.types}
    chosen: frozenset[str] = frozenset()
    fitting = contexts[number]
    for name in sorted(names, key=lambda t: (_frequency(groups, t), t)):  # rarest: they say most
        fewer = [
            found & np.array([name in o.types for o in group.table.space.objects])
            for group, found in zip(groups, fitting, strict=True)
        ]
        if _distinct(fewer, others):
            chosen, fitting = chosen | {name}, fewer
    return chosen, fitting


def _frequency(groups: Sequence[Group], type_name: str) -> int:
    return sum(type_name in o.types for g in groups for o in g.table.space.objects)

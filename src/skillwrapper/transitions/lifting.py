"""Lifting changes: from what changed around a skill instance to a change over parameters.

A lifted change names the skill's arguments by their positions 0 .. k-1 and every further object
(effect context, D2) by k, k+1, ...; equal up to renaming means equal as values.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from skillwrapper.symbols import Atom, Literal

MAX_PERMUTED_CONTEXT = 5
"""Up to so many context objects are renamed in all ways; more are sorted by their atoms."""

LiftedChange = tuple[tuple[bool, str, tuple[int, ...]], ...]
"""Sorted (became true, predicate, positions of the terms)."""


@dataclass(frozen=True)
class Lifting:
    """A change seen from a skill instance.

    Attributes:
        change: the connected part of the change, lifted.
        objects: the objects at the positions: the arguments, then the context.
        unexplained: changed atoms that are connected to no argument (D1), sorted.
    """

    change: LiftedChange
    objects: tuple[str, ...]
    unexplained: tuple[Atom, ...]


class Lifter:
    """Lifts changes and remembers them; of one domain, where a name stands for one object."""

    def __init__(self) -> None:
        self._known: dict[tuple[tuple[str, ...], tuple[Literal, ...]], Lifting] = {}

    def lift(
        self,
        changed: Iterable[Literal],
        arguments: tuple[str, ...],
        types: Mapping[str, tuple[str, ...]],
    ) -> Lifting:
        """As ``lift_change``."""
        key = (arguments, tuple(changed))
        if key not in self._known:
            self._known[key] = lift_change(key[1], arguments, types)
        return self._known[key]


def lift_change(
    changed: Iterable[Literal],
    arguments: Sequence[str],
    types: Mapping[str, tuple[str, ...]] | None = None,
) -> Lifting:
    """Lift the literals that became true with respect to the arguments of a skill instance.

    An atom belongs to the change if it is nullary or connected to an argument through objects
    that it shares with other changed atoms (D1).

    Args:
        changed: the literals that became true.
        arguments: the arguments of the skill instance.
        types: of the objects; context objects of one role are ordered by them, so that those
            of one type get the same position in every transition.
    """
    types = types or {}
    connected, rest = _split_connected(sorted(changed), arguments)
    context = sorted({t for literal in connected for t in literal.atom.terms} - set(arguments))
    change, _, order = min(
        (_rename(connected, (*arguments, *order)), [types.get(name, ()) for name in order], order)
        for order in _orders(context, connected, arguments)
    )
    return Lifting(change, (*arguments, *order), tuple(x.atom for x in rest))


def _split_connected(
    changed: Sequence[Literal], arguments: Sequence[str]
) -> tuple[list[Literal], list[Literal]]:
    reached = set(arguments)
    connected: list[Literal] = []
    rest = list(changed)
    while True:
        near = [x for x in rest if not x.atom.terms or reached.intersection(x.atom.terms)]
        if not near:
            return connected, rest
        connected += near
        rest = [x for x in rest if x not in near]
        reached.update(term for x in near for term in x.atom.terms)


def _rename(literals: Iterable[Literal], objects: Sequence[str]) -> LiftedChange:
    position = {name: number for number, name in enumerate(objects)}
    return tuple(
        sorted(
            (x.positive, x.atom.predicate, tuple(position[t] for t in x.atom.terms))
            for x in literals
        )
    )


def _orders(
    context: Sequence[str], literals: Sequence[Literal], arguments: Sequence[str]
) -> Iterable[tuple[str, ...]]:
    if len(context) <= MAX_PERMUTED_CONTEXT:
        return itertools.permutations(context)
    own = {name: f"#{number}" for number, name in enumerate(arguments)}

    def signature(name: str) -> list[str]:
        masked = {**own, name: "?"}
        return sorted(
            f"{x.positive}{x.atom.predicate}{[masked.get(t, '*') for t in x.atom.terms]}"
            for x in literals
            if name in x.atom.terms
        )

    return [tuple(sorted(context, key=lambda name: (signature(name), name)))]

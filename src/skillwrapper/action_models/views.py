"""Views: transitions of one action, looked at from its arguments alone.

A view holds what was true before and after of the lifted atoms over the action's parameters and
the domain's constants. Two transitions with the same view teach the same, so each is kept once:
a million transitions are a few hundred views.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from skillwrapper.action_models.skeleton import DomainSkeleton, LiftedAtom, Schema
from skillwrapper.action_models.steps import Step

_REMEMBERED = 100_000
"""For so many tuples of arguments the ground atoms are kept."""

Bits = NDArray[np.bool_]

UNKNOWN_BIT = 2
"""What views hold of an atom is 0 for false, 1 for true, or this."""

_Roles = tuple[str, ...]
"""For every argument the constant that it is, or the first parameter that is the same object."""

View = tuple[bytes, bytes, bool, _Roles]
"""What the atoms were before and after, whether the action worked, and what its arguments are."""


def some(seen: Bits) -> Bits:
    """Whether it is so in some view (atoms,), of what is so in which (views, atoms)."""
    found: Bits = np.logical_or.reduce(seen, axis=0)
    return found


@dataclass(frozen=True, eq=False)
class ViewTable:
    """All different views of one action, as arrays.

    Attributes:
        before: what was true before (views, atoms).
        after: what was true after (views, atoms).
        false_before: what was false before; neither is so of what is unknown (views, atoms).
        false_after: what was false after (views, atoms).
        success: whether the action was applicable (views,).
        equal: whether two parameters stood for one object (views, pairs of parameters).
        same: for every view the number (views, atoms) of the first atom that says the same:
            atoms differ unless two parameters, or one and a constant, stand for one object.
    """

    before: Bits
    after: Bits
    false_before: Bits
    false_after: Bits
    success: Bits
    equal: Bits
    same: NDArray[np.intp]

    @property
    def alone(self) -> Bits:
        """Whether no other atom says the same (views, atoms)."""
        counts = np.zeros(self.same.shape, dtype=np.intp)
        rows = np.arange(len(self.same))[:, np.newaxis]
        np.add.at(counts, (np.broadcast_to(rows, self.same.shape), self.same), 1)
        alone: Bits = np.take_along_axis(counts, self.same, axis=1) == 1
        return alone


class ActionViews:
    """Collects the views of one action.

    Args:
        skeleton: the domain.
        action: the action.

    Attributes:
        skeleton: the domain.
        action: the action.
        atoms: the lifted atoms that views are about.
        steps: how many transitions were taken in.
        unexplained: how many of them changed something that is no atom over the arguments.
        pairs: the pairs of parameters, by number, that may stand for one object.
    """

    def __init__(self, skeleton: DomainSkeleton, action: Schema) -> None:
        self.skeleton, self.action = skeleton, action
        self.atoms: tuple[LiftedAtom, ...] = tuple(skeleton.atoms_of(action))
        self.pairs = tuple(_pairs(skeleton, action))
        self.steps = 0
        self.unexplained = 0
        self._constants = frozenset(c.name for c in skeleton.constants)
        self._views: dict[View, None] = {}
        self._ground = lru_cache(_REMEMBERED)(self._ground_anew)

    def add(self, step: Step) -> None:
        """Take a transition in; its order among others does not matter."""
        ground, within, roles = self._ground(step.arguments)
        before = bytes(map(step.before.__contains__, ground))
        after = before
        if step.success and step.after is not step.before:
            after = bytes(map(step.after.__contains__, ground))
            self.unexplained += not (step.before ^ step.after) <= within
        self.steps += 1
        self._views[before, after, step.success, roles] = None

    def spell(self, arguments: tuple[str, ...]) -> tuple[str, ...]:
        """The ground atoms that ``atoms`` are with certain arguments, in their order."""
        return self._ground(arguments)[0]

    def view(self, arguments: tuple[str, ...], before: bytes, after: bytes, success: bool) -> View:
        """A view of whose atoms some are unknown; ``table`` takes it."""
        return before, after, success, self._ground(arguments)[2]

    def seen(self, table: ViewTable) -> frozenset[str]:
        """The predicates of which anything was true in a view."""
        return self._predicates(some(table.before) | some(table.after))

    def changed(self, table: ViewTable) -> frozenset[str]:
        """The predicates of which anything changed in a view."""
        rose, fell = table.false_before & table.after, table.before & table.false_after
        return self._predicates(some(rose | fell))

    def _predicates(self, chosen: Bits) -> frozenset[str]:
        return frozenset(a.predicate for a, own in zip(self.atoms, chosen, strict=True) if own)

    def table(self, more: Iterable[View] = ()) -> ViewTable:
        """All views so far, and more of this action."""
        views, size = list({**self._views, **dict.fromkeys(more)}), len(self.atoms)

        def values(column: int) -> NDArray[np.uint8]:
            joined = b"".join(view[column] for view in views)  # type: ignore[misc]
            return np.frombuffer(joined, dtype=np.uint8).reshape(len(views), size)

        before, after = values(0), values(1)

        same = [self._same(view[3]) for view in views]
        equal = [[view[3][i] == view[3][j] for i, j in self.pairs] for view in views]
        return ViewTable(
            before == 1,
            after == 1,
            before == 0,
            after == 0,
            np.array([view[2] for view in views], dtype=bool),
            np.array(equal, dtype=bool).reshape(len(views), len(self.pairs)),
            np.array(same, dtype=np.intp).reshape(len(views), size),
        )

    @cached_property
    def _names(self) -> tuple[str, ...]:
        return tuple(p.name for p in self.action.parameters)

    def _ground_anew(
        self, arguments: tuple[str, ...]
    ) -> tuple[tuple[str, ...], frozenset[str], _Roles]:
        """The ground atoms, in order and as a set, and what stands for every argument."""
        binding = dict(zip(self._names, arguments, strict=True))
        roles = tuple(
            name if name in self._constants else self._names[arguments.index(name)]
            for name in arguments
        )
        ground = tuple(atom.ground(binding) for atom in self.atoms)
        return ground, frozenset(ground), roles

    def _same(self, roles: _Roles) -> list[int]:
        names = dict(zip(self._names, roles, strict=True))
        first: dict[str, int] = {}
        return [first.setdefault(atom.ground(names), i) for i, atom in enumerate(self.atoms)]


def _pairs(skeleton: DomainSkeleton, action: Schema) -> Iterator[tuple[int, int]]:
    for (i, first), (j, second) in itertools.combinations(enumerate(action.parameters), 2):
        if skeleton.fits(first, second) or skeleton.fits(second, first):
            yield i, j

"""Columns of ground atoms looked up by the numbers of their objects, many bindings at once."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.symbols.predicates import Predicate
from skillwrapper.world.types import Object

ANY = -1
"""The position of a quantified object in the terms of an atom."""

Columns = NDArray[np.intp]


LiftedAtom = tuple[str, tuple[int, ...]]
"""A predicate with the positions of its terms; at most one of them is ``ANY``."""


@dataclass(frozen=True)
class AtomPatterns:
    """Lifted atoms over the positions of a binding, ready to be looked up.

    The place of a ground atom among all conceivable ones is linear in the numbers of its objects.

    Attributes:
        first: for every pattern (patterns,) the place of its predicate.
        weights: (patterns, positions) by what the number of the object at a position counts.
        quantified: (patterns,) by what the number of a quantified object counts.
    """

    first: Columns
    weights: Columns
    quantified: Columns


class AtomIndex:
    """Finds the columns of an atom space without a ground atom being made.

    Args:
        predicates: the vocabulary.
        objects: the objects of the scene.

    Attributes:
        number: the number of every object, by its name.
    """

    def __init__(self, predicates: Sequence[Predicate], objects: Sequence[Object]) -> None:
        self._objects = tuple(objects)
        self.number = {o.name: n for n, o in enumerate(self._objects)}
        self._of_type: dict[str, NDArray[np.bool_]] = {}
        self._first: dict[str, int] = {}
        self._compiled: dict[tuple[tuple[LiftedAtom, ...], int], AtomPatterns] = {}
        blocks: list[Columns] = []
        place = column = 0
        for predicate in predicates:
            grounded = self._groundings(predicate)
            block = np.full(grounded.shape, -1, dtype=np.intp)
            count = int(grounded.sum())
            block[grounded] = np.arange(column, column + count)
            self._first[predicate.name] = place
            blocks.append(block)
            place, column = place + len(block), column + count
        self._nowhere = place
        self._column = np.concatenate([*blocks, np.array([-1], dtype=np.intp)])

    def numbers(self, names: Iterable[str]) -> list[int]:
        """The numbers of several objects."""
        return [self.number[name] for name in names]

    def of_types(self, types: Iterable[str]) -> NDArray[np.bool_]:
        """Which objects (objects,) are of all the types."""
        found = np.ones(len(self._objects), dtype=bool)
        for name in types:
            found &= self._of(name)
        return found

    def patterns(self, atoms: Iterable[LiftedAtom], positions: int) -> AtomPatterns:
        """Compile lifted atoms, the same ones only once.

        Args:
            atoms: the atoms.
            positions: number of positions of a binding.
        """
        key = (tuple(atoms), positions)
        if key not in self._compiled:
            self._compiled[key] = self._compile(*key)
        return self._compiled[key]

    def columns(self, patterns: AtomPatterns, bindings: Columns) -> Columns:
        """Columns (bindings, patterns) for bindings (bindings, positions); -1 where none is."""
        if not len(patterns.first):
            return np.zeros((len(bindings), 0), dtype=np.intp)
        return self._column[self._places(patterns, bindings)]

    def open_columns(self, patterns: AtomPatterns, bindings: Columns) -> Columns:
        """Columns (bindings, patterns, objects), each object in turn being the quantified one."""
        size = len(self._objects)
        if not len(patterns.first):
            return np.zeros((len(bindings), 0, size), dtype=np.intp)
        step = patterns.quantified[:, np.newaxis] * np.arange(size)
        return self._column[self._places(patterns, bindings)[:, :, np.newaxis] + step]

    def _compile(self, atoms: tuple[LiftedAtom, ...], positions: int) -> AtomPatterns:
        weights = np.zeros((len(atoms), positions + 1), dtype=np.intp)  # the last one for ANY
        size = len(self._objects)
        first = np.full(len(atoms), self._nowhere, dtype=np.intp)
        for row, (name, terms) in enumerate(atoms):
            if name in self._first:
                first[row] = self._first[name]
                for place, term in enumerate(reversed(terms)):
                    weights[row, term] += size**place
        return AtomPatterns(first, weights[:, :positions], weights[:, positions])

    def _places(self, patterns: AtomPatterns, bindings: Columns) -> Columns:
        places: Columns = bindings @ patterns.weights.T + patterns.first
        return places

    def _groundings(self, predicate: Predicate) -> NDArray[np.bool_]:
        """Which tuples of objects, in their order, are groundings of a predicate."""
        shape = (len(self._objects),) * predicate.arity
        numbers = np.indices(shape, sparse=False) if shape else np.zeros((0,), dtype=np.intp)
        grounded = np.ones(shape, dtype=bool)
        for place, name in enumerate(predicate.types):
            grounded &= self._of(name)[numbers[place]]
        for one, other in itertools.combinations(range(predicate.arity), 2):
            grounded &= numbers[one] != numbers[other]
        return grounded.ravel()

    def _of(self, type_name: str) -> NDArray[np.bool_]:
        if type_name not in self._of_type:
            self._of_type[type_name] = np.array([type_name in o.types for o in self._objects])
        return self._of_type[type_name]


def taken_objects(bindings: Columns, size: int) -> NDArray[np.bool_]:
    """Which of so many objects (bindings, objects) stand at a position of a binding."""
    taken = np.zeros((len(bindings), size), dtype=bool)
    np.put_along_axis(taken, bindings, True, axis=1)
    return taken

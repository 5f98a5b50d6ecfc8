"""The ground atoms of a vocabulary in a scene, and abstract states as rows over them.

An abstract state is a row of ``int8`` over the ground atoms: ``TRUE`` (1), ``FALSE`` (0) or
``UNKNOWN`` (-1), see D10 in docs/semantics.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.atom_index import AtomIndex, Columns
from skillwrapper.symbols.predicates import Atom, Predicate, all_groundings
from skillwrapper.world.types import Object

TRUE, FALSE, UNKNOWN = 1, 0, -1
Labels = NDArray[np.int8]


@dataclass(frozen=True)
class AtomSpace:
    """The ground atoms of a vocabulary over the objects of a scene, one column each.

    Attributes:
        predicates: the vocabulary.
        objects: the objects of the scene.
    """

    predicates: tuple[Predicate, ...]
    objects: tuple[Object, ...]

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.predicates, self.objects))

    @cached_property
    def atoms(self) -> tuple[Atom, ...]:
        """The ground atoms in the order of their columns."""
        return all_groundings(self.predicates, self.objects)

    @cached_property
    def column(self) -> dict[Atom, int]:
        """The column of every ground atom."""
        return {atom: number for number, atom in enumerate(self.atoms)}

    @cached_property
    def index(self) -> AtomIndex:
        """Finds columns by the numbers of objects."""
        return AtomIndex(self.predicates, self.objects)

    @cached_property
    def mentions(self) -> NDArray[np.bool_]:
        """Whether each ground atom names each object (atoms, objects)."""
        found = np.zeros((len(self.atoms), len(self.objects)), dtype=bool)
        for number, atom in enumerate(self.atoms):
            found[number, self.index.numbers(atom.terms)] = True
        return found

    @cached_property
    def atoms_of(self) -> dict[str, tuple[Atom, ...]]:
        """The ground atoms of every predicate."""
        return {p.name: p.groundings(self.objects) for p in self.predicates}

    def columns(self, atoms: Iterable[Atom]) -> Columns:
        """Columns of several atoms, sorted."""
        return np.array(sorted(self.column[a] for a in atoms), dtype=np.intp)

    def true_atoms(self, state: Labels) -> frozenset[Atom]:
        """The atoms that are true in a state (shape: atoms)."""
        return frozenset(self.atoms[i] for i in np.flatnonzero(state == TRUE))

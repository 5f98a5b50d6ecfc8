"""Abstract states as users of a learned model meet them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from skillwrapper.errors import UnknownNameError
from skillwrapper.grounding import FALSE, TRUE, AtomSpace, Labels
from skillwrapper.planning.goals import Goal
from skillwrapper.symbols import Atom
from skillwrapper.world.scenes import Scene

_VALUES: Mapping[int, bool | None] = {TRUE: True, FALSE: False}


@dataclass(frozen=True, eq=False)
class AbstractState(Mapping[str, bool | None]):
    """What is true in a scene: for every ground atom True, False, or None for unknown.

    Atoms are named as they are printed: ``state["holding(robot, cup)"]``.

    Attributes:
        scene: the objects that are present.
        space: the ground atoms over them.
        labels: one for each of them (atoms,).
    """

    scene: Scene
    space: AtomSpace
    labels: Labels

    def __getitem__(self, name: str) -> bool | None:
        """The label of an atom.

        Raises:
            UnknownNameError: if there is no such atom; a ``KeyError`` would not say which there
                are.
        """
        known = {str(atom): column for atom, column in self.space.column.items()}
        if name not in known:
            raise UnknownNameError("atom", name, known)
        return _VALUES.get(int(self.labels[known[name]]))

    def __iter__(self) -> Iterator[str]:
        return (str(atom) for atom in self.space.atoms)

    def __len__(self) -> int:
        return len(self.space.atoms)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, AbstractState)
            and self.space == other.space
            and bool(np.array_equal(self.labels, other.labels))
        )

    __hash__ = None  # type: ignore[assignment]

    @property
    def true(self) -> frozenset[Atom]:
        """The atoms that are true."""
        return self.space.true_atoms(self.labels)

    def satisfies(self, goal: Goal) -> bool:
        """Whether a goal holds; unknown counts as false, as in planning."""
        return goal.holds(self.space, self.labels)

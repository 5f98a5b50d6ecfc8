"""How a method comes by the abstract state of a true state: off its picture, or from the truth."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, AtomSpace, Labels
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Atom
from skillwrapper.world.capabilities import Enumerable, Truthful, look_at


class StateReader(Protocol):
    """Labels states."""

    def read(self, space: AtomSpace, states: Sequence[Any]) -> Labels:
        """Labels of states (states, atoms), seen in the environment's present layout."""
        ...


@dataclass(frozen=True)
class PictureReader:
    """Reads labels off the pictures of states.

    Attributes:
        environment: draws the pictures, in its present layout.
        source: reads them.
    """

    environment: Enumerable
    source: TruthSource

    def read(self, space: AtomSpace, states: Sequence[Any]) -> Labels:
        """Labels of states (states, atoms)."""
        return self.source.labels(space, look_at(self.environment, states))


@dataclass(frozen=True)
class AtomReader:
    """Knows the true atoms of states; looks at no picture.

    Attributes:
        true_atoms: the true atoms of a state; all others are false.
    """

    true_atoms: Callable[[Any], Iterable[Atom]]

    def read(self, space: AtomSpace, states: Sequence[Any]) -> Labels:
        """Labels of states (states, atoms)."""
        labels = np.full((len(states), len(space.atoms)), FALSE, dtype=np.int8)
        for row, state in enumerate(states):
            for atom in self.true_atoms(state):
                if atom in space.column:
                    labels[row, space.column[atom]] = TRUE
        return labels


def system_reader(environment: Truthful) -> AtomReader:
    """The simulator's own description of its states."""
    return AtomReader(lambda state: (Atom(*pair) for pair in environment.true_atoms(state)))

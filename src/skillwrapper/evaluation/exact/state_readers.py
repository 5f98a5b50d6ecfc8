"""How the abstract state of a true state is known: off its picture, or from the simulator."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, AtomSpace, Labels
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Atom
from skillwrapper.world.capabilities import Settable, Truthful
from skillwrapper.world.observation import Observation


@dataclass(frozen=True)
class Situation:
    """A moment of the world.

    Attributes:
        look: what is seen in it; called only by who looks.
        state: its true state; None where nobody knows it.
    """

    look: Callable[[], Observation]
    state: Any = None

    @classmethod
    def of_state(cls, environment: Settable, state: Any) -> Situation:
        """A state of the present scene; looking puts the environment into it."""
        return cls(lambda: environment.set_state(state), state)

    @classmethod
    def seen(cls, observation: Observation, state: Any = None) -> Situation:
        """What was seen already."""
        return cls(lambda: observation, state)


class StateReader(Protocol):
    """Labels situations."""

    def read(self, space: AtomSpace, situations: Sequence[Situation]) -> Labels:
        """Labels (situations, atoms)."""
        ...


@dataclass(frozen=True)
class PictureReader:
    """Looks, and reads what is seen.

    Attributes:
        source: reads pictures.
    """

    source: TruthSource

    def read(self, space: AtomSpace, situations: Sequence[Situation]) -> Labels:
        """Labels (situations, atoms)."""
        return self.source.labels(space, [situation.look() for situation in situations])


@dataclass(frozen=True)
class AtomReader:
    """Knows the true atoms of states; looks at no picture.

    Attributes:
        true_atoms: the true atoms of a state; all others are false.
    """

    true_atoms: Callable[[Any], Iterable[Atom]]

    def read(self, space: AtomSpace, situations: Sequence[Situation]) -> Labels:
        """Labels (situations, atoms)."""
        labels = np.full((len(situations), len(space.atoms)), FALSE, dtype=np.int8)
        for row, situation in enumerate(situations):
            for atom in self.true_atoms(situation.state):
                if atom in space.column:
                    labels[row, space.column[atom]] = TRUE
        return labels


def system_reader(environment: Truthful) -> AtomReader:
    """The simulator's own description of its states."""
    return AtomReader(lambda state: (Atom(*pair) for pair in environment.true_atoms(state)))

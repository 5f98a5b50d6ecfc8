"""The burger kitchen, read with errors: the same error whenever the same picture is read."""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from kitchen import CONCEPTS, DOMAIN, STATES, explore, label_states

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world import Episode, Observation, Picture

VOCABULARY = tuple(
    p
    for p in CONCEPTS
    if p.name
    in ("hand_empty", "holding", "on_station", "stacked_on", "nothing_on", "station_empty")
    or p.name in ("is_cut", "is_cooked")
)


class MisreadKitchen:
    """Episodes in which every layout has pictures of its own, and who reads them.

    Args:
        executions: how many skills are run, 15 an episode.
        seed: of everything.
        rate: share of the readings that are wrong.
    """

    def __init__(self, executions: int, seed: int, rate: float = 0.0) -> None:
        self.recorded, self._seed, self._rate = RecordedTransitions(DOMAIN), seed, rate
        for number in range(-(-executions // 15)):
            self.recorded.add(_redrawn(explore(15, seed * 1000 + number), number))

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing to do: all labels are there."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms) as they are read (``TruthSource``)."""
        return np.where(self._errs(space, observations), 1 - self.truth(space, observations),
                        self.truth(space, observations)).astype(np.int8)  # fmt: skip

    def truth(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms) as they should be read."""
        numbers = [int(o.pictures[0].png.split(b"/")[0]) for o in observations]
        return label_states(space, [STATES[n] for n in numbers])

    def _errs(self, space: AtomSpace, observations: Sequence[Observation]) -> np.ndarray:
        chances = [
            [zlib.crc32(f"{self._seed} {o.key} {a}".encode()) / 2**32 for a in space.atoms]
            for o in observations
        ]
        return np.array(chances).reshape(len(observations), len(space.atoms)) < self._rate


def space_of(predicates: Sequence[Predicate] = VOCABULARY) -> AtomSpace:
    """The ground atoms of a vocabulary in the kitchen."""
    return AtomSpace(tuple(predicates), DOMAIN.objects)


def _redrawn(episode: Episode, layout: int) -> Episode:
    def redrawn(seen: Observation) -> Observation:
        return Observation((Picture(seen.pictures[0].png + b"/%d" % layout),))

    transitions = (
        replace(t, before=redrawn(t.before), after=redrawn(t.after)) for t in episode.transitions
    )
    return replace(episode, transitions=tuple(transitions))

"""From recorded transitions to labelled ones: the labels of their pictures, as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

import numpy as np

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.labelled import (
    LabelledTransitions,
    PredicateLabels,
    SceneTransitions,
    split_labels,
)
from skillwrapper.transitions.lifting import Lifter
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


class TruthSource(Protocol):
    """Where the labels of pictures come from; gives the same ones whenever it is asked."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms) of the ground atoms."""
        ...

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Announce what will be needed, so that it can be asked for at once."""
        ...


class Labeller:
    """Labels recorded transitions with any vocabulary; what was read is kept as arrays.

    Args:
        recorded: the transitions; may grow.
        truth: the labels of their pictures.
    """

    def __init__(self, recorded: RecordedTransitions, truth: TruthSource) -> None:
        self.recorded = recorded
        self.truth = truth
        self._size = 0
        self._read: dict[tuple[Scene, Predicate], PredicateLabels] = {}
        self._labelled: dict[tuple[Predicate, ...], LabelledTransitions] = {}
        self._lifter = Lifter()

    def label(self, predicates: Sequence[Predicate]) -> LabelledTransitions:
        """All transitions so far, with the labels of a vocabulary."""
        if self._size != len(self.recorded):
            self._size = len(self.recorded)
            self._labelled.clear()
        chosen = tuple(predicates)
        if chosen not in self._labelled:
            scenes = tuple(
                SceneTransitions(self.recorded.executions(s), self._labels(s, chosen))
                for s in self.recorded.scenes
            )
            self._labelled[chosen] = LabelledTransitions(
                self.recorded.domain, chosen, scenes, self._lifter
            )
        return self._labelled[chosen]

    def values(self, scene: Scene, predicates: Sequence[Predicate]) -> Labels:
        """Labels (observations, atoms) of all observations of a scene."""
        labels = self._labels(scene, predicates)
        shape = (len(self.recorded.observations(scene)), 0)
        return np.hstack([x.values for x in labels]) if labels else np.zeros(shape, dtype=np.int8)

    def _labels(self, scene: Scene, predicates: Sequence[Predicate]) -> tuple[PredicateLabels, ...]:
        observations = self.recorded.observations(scene)
        missing = [p for p in predicates if not self._is_read(scene, p, len(observations))]
        if missing:
            space = AtomSpace(tuple(missing), scene.objects)
            for labels in split_labels(space, self.truth.labels(space, observations)):
                self._read[scene, labels.predicate] = labels
        return tuple(self._read[scene, p] for p in predicates)

    def _is_read(self, scene: Scene, predicate: Predicate, observations: int) -> bool:
        known = self._read.get((scene, predicate))
        return known is not None and len(known.values) == observations

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
            self.announce(chosen)
            scenes = tuple(
                SceneTransitions(self.recorded.executions(s), self._labels(s, chosen))
                for s in self.recorded.scenes
            )
            self._labelled[chosen] = LabelledTransitions(
                self.recorded.domain, chosen, scenes, self._lifter
            )
        return self._labelled[chosen]

    def announce(self, predicates: Sequence[Predicate]) -> None:
        """Have all pictures read together of which labels of predicates will be needed."""
        missing = [(scene, self._missing(scene, predicates)) for scene in self.recorded.scenes]
        self.truth.prefetch(
            (AtomSpace(unread, scene.objects), self.recorded.observations(scene))
            for scene, unread in missing
            if unread
        )

    def values(self, scene: Scene, predicates: Sequence[Predicate]) -> Labels:
        """Labels (observations, atoms) of all observations of a scene."""
        return self._joined(scene, self._labels(scene, predicates))

    def read(self, scene: Scene, observation: Observation, space: AtomSpace) -> Labels:
        """Labels (atoms,) of one observation of a scene."""
        labels: Labels = self.truth.labels(space, [observation])[0]
        return labels

    @property
    def misread(self) -> float:
        """The share of readings that is expected to be wrong; 0 if all are taken for right."""
        return 0.0

    def misreadings(self, predicate: Predicate) -> float:
        """What was read of a predicate takes as much to describe as so many misreadings.

        Those that there are count, and the rules by which it changes; 0 if all readings are taken
        for right.
        """
        return 0.0

    def doubt(self, number: int) -> float:
        """The probability that something is misread in the pictures of a transition."""
        return 0.0

    def around(self, numbers: Sequence[int]) -> TruthSource | None:
        """Labels of the pictures of some transitions, by those around them too.

        None where readings are taken for right: pictures around tell nothing more then.
        """
        return None

    def _joined(self, scene: Scene, labels: Sequence[PredicateLabels]) -> Labels:
        shape = (len(self.recorded.observations(scene)), 0)
        return np.hstack([x.values for x in labels]) if labels else np.zeros(shape, dtype=np.int8)

    def _labels(self, scene: Scene, predicates: Sequence[Predicate]) -> tuple[PredicateLabels, ...]:
        missing = self._missing(scene, predicates)
        if missing:
            space = AtomSpace(missing, scene.objects)
            values = self.truth.labels(space, self.recorded.observations(scene))
            for labels in split_labels(space, values):
                self._read[scene, labels.predicate] = labels
        return tuple(self._read[scene, p] for p in predicates)

    def _missing(self, scene: Scene, predicates: Sequence[Predicate]) -> tuple[Predicate, ...]:
        """The predicates that are not read in all pictures of a scene."""
        number = len(self.recorded.observations(scene))
        known = ((p, self._read.get((scene, p))) for p in predicates)
        return tuple(p for p, labels in known if labels is None or len(labels.values) != number)

"""Labels of recorded transitions as the likeliest states behind what was read (D24)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.perception.decoding.chains import Chain, chains_of
from skillwrapper.perception.decoding.decoder import Decoding, decode
from skillwrapper.perception.decoding.odds import Floats, to_probability
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.labelling import Labeller, TruthSource
from skillwrapper.perception.surroundings import Surroundings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.labelled import LabelledTransitions, PredicateLabels
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


class DecodedLabeller(Labeller):
    """Labels with the probability that each is right.

    The vocabulary in use is decoded together, every other predicate by itself, given these. What
    is decoded depends on the data and the vocabulary alone, never on what was decoded before.

    Args:
        recorded: the transitions; may grow.
        truth: the readings of their pictures.
        vocabulary: the predicates in use now.
        priors: what is believed of readings beforehand.
    """

    def __init__(
        self,
        recorded: RecordedTransitions,
        truth: TruthSource,
        vocabulary: Callable[[], Sequence[Predicate]],
        priors: Priors | None = None,
    ) -> None:
        super().__init__(recorded, truth)
        self._vocabulary, self._priors = vocabulary, priors or Priors()
        self._key: tuple[int, tuple[Predicate, ...]] | None = None
        self._chains: tuple[Chain, ...] = ()
        self._together: Decoding | None = None
        self._alone: dict[Predicate, Decoding] = {}
        self._decoded: dict[tuple[Scene, Predicate], PredicateLabels] = {}

    def label(self, predicates: Sequence[Predicate]) -> LabelledTransitions:
        """All transitions so far, with the decoded labels of a vocabulary."""
        self._keep_up()
        return super().label(predicates)

    def read(self, scene: Scene, observation: Observation, space: AtomSpace) -> Labels:
        """Labels (atoms,) of one observation: decoded if it was recorded, else as it is read."""
        number = self.recorded.number_of(scene, observation)
        if number is None:
            return super().read(scene, observation, space)
        labels: Labels = self.values(scene, space.predicates)[number]
        return labels

    @property
    def misread(self) -> float:
        """The share of readings that is expected to be wrong, as estimated so far."""
        estimated = self.decoding.misread
        return self._priors.misread if estimated is None else estimated

    def misreadings(self, predicate: Predicate) -> float:
        """What was read of a predicate takes as much to describe as so many misreadings."""
        self._keep_up()
        return self._decoding_of(predicate).nats[predicate] / self._priors.reading_odds

    def doubt(self, number: int) -> float:
        """The probability that something is misread in the pictures of a transition."""
        record = self.recorded.records[number]
        dirt = dict(zip((c.scene for c in self._chains), self.decoding.dirt, strict=True))
        nodes = [record.before, record.after]
        return float(to_probability(dirt[record.scene][nodes]).max())

    def around(self, numbers: Sequence[int]) -> TruthSource:
        """Labels of the pictures of some transitions, decoded with those around them."""
        self._keep_up()
        return Surroundings(self.recorded, self.truth, self._chains, numbers, self._decode_given)

    @property
    def decoding(self) -> Decoding:
        """What is believed of the vocabulary in use."""
        self._keep_up()
        if self._together is None:
            labels = self._readings_of(self._in_use)
            self._together = decode(self._chains, self._in_use, labels, self._priors)
        return self._together

    def readings(self, scene: Scene, predicates: Sequence[Predicate]) -> Labels:
        """Labels (observations, atoms) as they were read."""
        return self._joined(scene, super()._labels(scene, predicates))

    def _labels(self, scene: Scene, predicates: Sequence[Predicate]) -> tuple[PredicateLabels, ...]:
        self._keep_up()
        self.announce(predicates)
        return tuple(self._labels_of(scene, predicate) for predicate in predicates)

    def _labels_of(self, scene: Scene, predicate: Predicate) -> PredicateLabels:
        if (scene, predicate) not in self._decoded:
            for chain, posterior in zip(
                self._chains, self._decoding_of(predicate).posterior, strict=True
            ):
                self._decoded[chain.scene, predicate] = _to_labels(predicate, posterior[predicate])
        return self._decoded[scene, predicate]

    def _decoding_of(self, predicate: Predicate) -> Decoding:
        if predicate in self._in_use:
            return self.decoding
        if predicate not in self._alone:
            labels = self._readings_of((predicate,))
            self._alone[predicate] = self._decode_given(predicate, labels)
        return self._alone[predicate]

    def _decode_given(self, predicate: Predicate, labels: Sequence[Labels]) -> Decoding:
        """Decode a predicate by itself, given those in use."""
        given = self.decoding.without({predicate.name})
        return decode(self._chains, (predicate,), labels, self._priors, given)

    def _readings_of(self, predicates: Sequence[Predicate]) -> list[Labels]:
        return [self.readings(chain.scene, predicates) for chain in self._chains]

    @property
    def _in_use(self) -> tuple[Predicate, ...]:
        return self._key[1] if self._key is not None else ()

    def _keep_up(self) -> None:
        """Forget what was decoded of fewer transitions, or of another vocabulary."""
        key = (len(self.recorded), tuple(self._vocabulary()))
        if key != self._key:
            if self._key is None or key[0] != self._key[0]:
                self._chains = chains_of(self.recorded)
            self._key, self._together = key, None
            self._alone.clear()
            self._decoded.clear()
            self._labelled.clear()


def _to_labels(predicate: Predicate, posterior: Floats) -> PredicateLabels:
    values = (posterior > 0.5).astype(np.int8)
    confidence = np.maximum(posterior, 1 - posterior).astype(np.float32)
    return PredicateLabels(predicate, values, confidence)

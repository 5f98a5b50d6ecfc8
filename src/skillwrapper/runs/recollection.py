"""What a run has recorded, with its labels as they were read and corrected; nothing is asked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import UNKNOWN, AtomSpace, Labels
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import make_learner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.archive import ArchivedIteration
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.runs.corrections import Corrections
from skillwrapper.runs.results import SceneLabels
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.episode import Episode
from skillwrapper.world.observation import Observation


@dataclass(frozen=True)
class CorrectedTruth:
    """The labels of a run as they were read, and corrected.

    Attributes:
        read: what was read.
        names: by the present name of every predicate, the one it was read under.
        corrections: what stands above it.
    """

    read: RecordedLabels
    names: Mapping[str, str]
    corrections: Corrections

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms); what was never read is unknown."""
        rows = [[self._label(o.key, atom) for atom in space.atoms] for o in observations]
        return np.array(rows, dtype=np.int8).reshape(len(observations), len(space.atoms))

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing: everything is there."""

    def _label(self, key: str, atom: Atom) -> int:
        read = self.read.of(key).get(str(Atom(self.names[atom.predicate], atom.terms)))
        label = self.corrections.labels.get((key, atom), read)
        return UNKNOWN if label is None else int(label)


@dataclass(frozen=True, eq=False)
class Recollection:
    """All that was recorded up to the last finished iteration of a run.

    Attributes:
        latest: that iteration.
        settings: of the run.
        episodes: of the finished iterations.
        recorded: their transitions.
        truth: what is true in their pictures.
        vocabulary: the predicates of the iteration, as they were corrected.
        corrections: what a person has corrected.
        labeller: labels the transitions.
    """

    latest: ArchivedIteration
    settings: RunSettings
    episodes: tuple[Episode, ...]
    recorded: RecordedTransitions
    truth: CorrectedTruth
    vocabulary: tuple[Predicate, ...]
    corrections: Corrections
    labeller: Labeller

    @classmethod
    def of(cls, archive: RunArchive) -> Recollection:
        """What an archive holds.

        Raises:
            UserError: if no iteration is finished, or a file is damaged.
        """
        latest, corrections = archive.latest(), Corrections.of(archive.corrections())
        recorded = RecordedTransitions(archive.domain())
        episodes = archive.episodes()
        for episode in episodes:
            recorded.add(episode)
        corrected = {p: corrections.applied(p) for p in latest.model.predicates}
        names = {now.name: p.name for p, now in corrected.items() if now is not None}
        vocabulary = tuple(now for now in corrected.values() if now is not None)
        truth = CorrectedTruth(latest.labels, names, corrections)
        settings = archive.settings()
        labeller = _labeller(settings, recorded, truth, vocabulary)
        return cls(latest, settings, episodes, recorded, truth, vocabulary, corrections, labeller)

    def fit(self) -> Fit:
        """What is learned from it."""
        return Fitter(self.labeller, make_learner(self.settings.learning)).fit(self.vocabulary)

    def labels(self) -> tuple[SceneLabels, ...]:
        """The labels of all pictures, scene by scene."""
        found = []
        for scene in self.recorded.scenes:
            space = AtomSpace(self.vocabulary, scene.objects)
            seen = self.recorded.observations(scene)
            found.append(SceneLabels(space, seen, self.truth.labels(space, seen)))
        return tuple(found)


def _labeller(
    settings: RunSettings,
    recorded: RecordedTransitions,
    truth: CorrectedTruth,
    vocabulary: Sequence[Predicate],
) -> Labeller:
    if not settings.decodes_labels:
        return Labeller(recorded, truth)
    priors = settings.perception.decoding
    return DecodedLabeller(recorded, truth, lambda: vocabulary, priors)

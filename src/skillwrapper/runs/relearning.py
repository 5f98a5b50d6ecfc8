"""Learning operators anew from corrected labels, without asking or executing anything."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import UNKNOWN, AtomSpace, Labels
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.certification import certify
from skillwrapper.learning.inconsistencies import distinct_causes
from skillwrapper.learning.learner import make_learner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.perception.overruling import certify_decoding
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.archive import ArchivedIteration
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.runs.archive.writer import ArchiveWriter
from skillwrapper.runs.corrections import Corrections
from skillwrapper.runs.results import LearningResult, ReadingCosts, SceneLabels
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


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


def relearn(archive: RunArchive) -> LearningResult:
    """Learn from what is recorded with the present corrections, and write down what comes of it.

    The vocabulary is that of the last finished iteration, as it was corrected; its files and the
    model of the run are replaced.

    Args:
        archive: of a run that nobody else works in.

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
    fit = Fitter(labeller, make_learner(settings.learning)).fit(vocabulary)
    decoding = None
    if isinstance(labeller, DecodedLabeller):
        decoding = certify_decoding(labeller, settings.learning.least_confidence)
    kept = _Kept.of(latest, names)
    result = LearningResult(
        fit=fit,
        certificate=certify(fit),
        unresolved=distinct_causes(fit.inconsistencies),
        episodes=episodes,
        decisions=(),
        converged=kept.converged,
        readings=kept.readings,
        pairs_covered=kept.pairs_covered,
        agreement=kept.agreement,
        decoding=decoding,
    )
    labels = tuple(_labels(truth, recorded, scene, vocabulary) for scene in recorded.scenes)
    ArchiveWriter(archive).write_relearned(latest.number, result, labels)
    return result


def _labels(
    truth: CorrectedTruth,
    recorded: RecordedTransitions,
    scene: Scene,
    vocabulary: tuple[Predicate, ...],
) -> SceneLabels:
    space, seen = AtomSpace(vocabulary, scene.objects), recorded.observations(scene)
    return SceneLabels(space, seen, truth.labels(space, seen))


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


@dataclass(frozen=True)
class _Kept:
    """Figures that corrections do not change."""

    converged: bool
    readings: ReadingCosts
    pairs_covered: float
    agreement: Mapping[str, float]

    @classmethod
    def of(cls, latest: ArchivedIteration, names: Mapping[str, str]) -> _Kept:
        found = latest.summary
        agreement = {
            now: found.agreement[had] for now, had in names.items() if had in found.agreement
        }
        readings = ReadingCosts(found.evaluation_calls, found.evaluation_calls_reasking)
        return cls(found.converged, readings, found.pairs_covered, agreement)

"""The error on episodes that a model was not learned from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from skillwrapper.errors import RunFolderError
from skillwrapper.evaluation.theory.intervals import clopper_pearson
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import make_learner
from skillwrapper.learning.predictions import predict
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller, TruthSource
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.recorded_readings import RecordedReadings
from skillwrapper.runs.settings import SharedSettings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.labelled import LabelledTransitions
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode

_LEAST_EPISODES = 2


@dataclass(frozen=True)
class HeldBackError:
    """How often models are wrong about an episode that was held back while they were learned.

    The vocabulary is the run's, invented from all episodes; so it is operators that are tested,
    and a doubt about the vocabulary remains. Transitions of one episode depend on each other: the
    interval is for independent ones, and therefore narrower than the truth.

    Where labels are decoded, those of a held-back episode are decoded with all others, so they
    lean towards what the model says, and misreadings that decoding does not find count as errors:
    the interval is then an estimate. Beside the labels as they were read, every misreading counts
    as an error of the model; so the true error is no greater.

    Attributes:
        wrong: transitions whose outcome or change was predicted wrongly.
        tried: transitions that were predicted at all.
        undecided: transitions that hang on an unknown label.
        confidence: of the interval.
        interval: Clopper-Pearson's.
        wrong_as_read: as ``wrong``, beside the labels as they were read; None if these are used.
        tried_as_read: likewise.
    """

    wrong: int
    tried: int
    undecided: int
    confidence: float
    interval: tuple[float, float]
    wrong_as_read: int | None = None
    tried_as_read: int | None = None

    @property
    def at_most(self) -> float:
        """What the true error does not exceed, misreadings or not."""
        if self.wrong_as_read is None or not self.tried_as_read:
            return self.interval[1]
        read = clopper_pearson(self.wrong_as_read, self.tried_as_read, self.confidence)
        return max(self.interval[1], read[1])


@dataclass
class _Tally:
    wrong: int = 0
    tried: int = 0
    undecided: int = 0

    def add(self, fit: Fit, held: LabelledTransitions, numbers: range, least: float) -> None:
        """Compare predictions with held-back transitions, which are some of all by number."""
        decided = held.decided(least)
        for skill in held.domain.skills:
            for found in predict(decided.of_skill(skill.name), fit.skill(skill.name).operators):
                own = (found.table.ids >= numbers.start) & (found.table.ids < numbers.stop)
                self.wrong += int((own & found.wrong & ~found.undecided).sum())
                self.tried += int((own & ~found.undecided).sum())
                self.undecided += int((own & found.undecided).sum())


def held_back_error(archive: RunArchive, confidence: float = 0.95) -> HeldBackError:
    """Learn from all episodes of a run but one, predict that one, and so for each.

    Args:
        archive: a run with at least two finished iterations.
        confidence: of the interval.

    Raises:
        RunFolderError: if there are too few episodes.
        FileError: if a record is damaged.
    """
    latest, episodes = archive.latest(), archive.episodes()
    if len(episodes) < _LEAST_EPISODES:
        raise RunFolderError(f"{archive.path}: expected two episodes or more, got {len(episodes)}")
    readings, words = RecordedReadings(latest.labels), latest.model.predicates
    labelling = Labelling(archive.domain(), readings, words, archive.settings())
    return hold_back(episodes, labelling, confidence)


@dataclass(frozen=True)
class Labelling:
    """How transitions are labelled and learned from.

    Attributes:
        domain: types, objects and skills.
        readings: what was read in all pictures.
        words: the vocabulary.
        settings: whether labels are decoded, and who learns.
    """

    domain: Domain
    readings: TruthSource
    words: tuple[Predicate, ...]
    settings: SharedSettings

    def label(self, episodes: Sequence[Episode], *, decodes: bool) -> LabelledTransitions:
        """The labelled transitions of some episodes, by these alone."""
        recorded = RecordedTransitions.of(self.domain, episodes)
        if not decodes:
            return Labeller(recorded, self.readings).label(self.words)
        priors = self.settings.perception.decoding
        return DecodedLabeller(recorded, self.readings, lambda: self.words, priors).label(
            self.words
        )


def hold_back(
    episodes: Sequence[Episode], labelling: Labelling, confidence: float = 0.95
) -> HeldBackError:
    """Learn from all episodes but one, predict that one, and so for each.

    Args:
        episodes: at least two.
        labelling: how they are labelled.
        confidence: of the interval.
    """
    settings, decodes = labelling.settings.learning, labelling.settings.decodes_labels
    learner, least = make_learner(settings), settings.least_confidence
    believed = labelling.label(episodes, decodes=decodes)
    as_read = labelling.label(episodes, decodes=False)
    decoded, raw = _Tally(), _Tally()
    first = 0
    for held, episode in enumerate(episodes):
        others = (*episodes[:held], *episodes[held + 1 :])
        fit = learner.learn(labelling.label(others, decodes=decodes))
        own = range(first, first + len(episode.transitions))
        decoded.add(fit, believed, own, least)
        raw.add(fit, as_read, own, least)
        first = own.stop
    interval = (0.0, 1.0)
    if decoded.tried:
        interval = clopper_pearson(decoded.wrong, decoded.tried, confidence)
    found = HeldBackError(decoded.wrong, decoded.tried, decoded.undecided, confidence, interval)
    if not decodes:
        return found
    return replace(found, wrong_as_read=raw.wrong, tried_as_read=raw.tried)

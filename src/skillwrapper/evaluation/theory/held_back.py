"""The error on episodes that a model was not learned from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from skillwrapper.errors import RunFolderError
from skillwrapper.evaluation.theory.intervals import clopper_pearson
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import make_learner
from skillwrapper.learning.predictions import predict
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.transitions.entries import label_entries
from skillwrapper.transitions.labelled import LabelledTransitions
from skillwrapper.world.episode import Episode

_LEAST_EPISODES = 2


@dataclass(frozen=True)
class HeldBackError:
    """How often models are wrong about an episode that was held back while they were learned.

    The vocabulary is the run's, invented from all episodes; so it is operators that are tested,
    and a doubt about the vocabulary remains. Transitions of one episode depend on each other: the
    interval is for independent ones, and therefore narrower than the truth.

    Attributes:
        wrong: transitions whose outcome or change was predicted wrongly.
        tried: transitions that were predicted at all.
        undecided: transitions that hang on an unknown label.
        confidence: of the interval.
        interval: Clopper-Pearson's.
    """

    wrong: int
    tried: int
    undecided: int
    confidence: float
    interval: tuple[float, float]


def held_back_error(archive: RunArchive, confidence: float = 0.95) -> HeldBackError:
    """Learn from all episodes but one, predict that one, and so for each.

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
    domain, words, settings = archive.domain(), latest.model.predicates, archive.settings().learning
    entries = [_entries(episode, latest.labels) for episode in episodes]
    learner = make_learner(settings)
    wrong = tried = undecided = 0
    for held, own in enumerate(entries):
        others = [e for number, some in enumerate(entries) if number != held for e in some]
        fit = learner.learn(label_entries(domain, others, words))
        found = _compare(fit, label_entries(domain, own, words), settings)
        wrong, tried, undecided = wrong + found[0], tried + found[1], undecided + found[2]
    interval = clopper_pearson(wrong, tried, confidence) if tried else (0.0, 1.0)
    return HeldBackError(wrong, tried, undecided, confidence, interval)


def _entries(episode: Episode, labels: RecordedLabels) -> list[dict[str, Any]]:
    return [
        {
            "skill": t.instance.skill,
            "arguments": list(t.instance.arguments),
            "success": t.success,
            "before": dict(labels.of(t.before.key)),
            "after": dict(labels.of(t.after.key)),
            "scene": episode.scene.name,
            "changed": t.changed,
        }
        for t in episode.transitions
    ]


def _compare(
    fit: Fit, data: LabelledTransitions, settings: LearnerSettings
) -> tuple[int, int, int]:
    """Wrong, decided and undecided predictions of held-back transitions."""
    wrong = tried = undecided = 0
    decided = data.decided(settings.least_confidence)
    for skill in data.domain.skills:
        for found in predict(decided.of_skill(skill.name), fit.skill(skill.name).operators):
            wrong += int((found.wrong & ~found.undecided).sum())
            tried += int((~found.undecided).sum())
            undecided += int(found.undecided.sum())
    return wrong, tried, undecided

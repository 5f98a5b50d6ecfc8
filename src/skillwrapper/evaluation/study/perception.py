"""How often models read predicates rightly, under several conditions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skillwrapper.evaluation.published import PublishedPerception
from skillwrapper.evaluation.study.conditions import Condition
from skillwrapper.evaluation.study.models import StudiedModel, open_studied
from skillwrapper.evaluation.study.scoring import (
    PredicateScore,
    mean_accuracy,
    score_predicate,
    share_clean,
)
from skillwrapper.evaluation.study.subjects import Sample, Subject
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.vlm.assistant import Assistant


@dataclass(frozen=True)
class ConditionResult:
    """How well one model reads under one condition.

    Attributes:
        model: the model.
        condition: the condition.
        scores: one for each predicate.
        clean: share of the pictures in which nothing is misread; None without any.
    """

    model: StudiedModel
    condition: Condition
    scores: tuple[PredicateScore, ...]
    clean: float | None = None

    @property
    def accuracy(self) -> float | None:
        """Mean accuracy over the predicates, by groundings."""
        return mean_accuracy(self.scores, lifted=False)

    @property
    def lifted_accuracy(self) -> float | None:
        """Mean accuracy over the predicates as the paper defines it."""
        return mean_accuracy(self.scores, lifted=True)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "model": self.model.label,
            "embedded": self.model.is_embedded,
            "condition": self.condition.name,
            "meaning": self.condition.meaning,
            "accuracy": self.accuracy,
            "lifted_accuracy": self.lifted_accuracy,
            "clean": self.clean,
            "predicates": [score.to_json() for score in self.scores],
        }


@dataclass(frozen=True)
class PerceptionStudy:
    """What a study found.

    Attributes:
        origin: which predicates were read, and where their truth comes from.
        pictures: how many pictures were read under each condition.
        results: by condition, then by model.
        left_out: conditions that could not be shown.
        published: figures of others to stand beside.
    """

    origin: str
    pictures: int
    results: tuple[ConditionResult, ...]
    left_out: tuple[str, ...]
    published: PublishedPerception

    @property
    def models(self) -> tuple[StudiedModel, ...]:
        """The models in the order in which they were given."""
        return tuple(dict.fromkeys(result.model for result in self.results))

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The conditions that were shown."""
        return tuple(dict.fromkeys(result.condition for result in self.results))

    def result(self, model: StudiedModel, condition: Condition) -> ConditionResult:
        """The result of one model under one condition."""
        return next(r for r in self.results if (r.model, r.condition) == (model, condition))

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "origin": self.origin,
            "pictures": self.pictures,
            "left_out": list(self.left_out),
            "results": [result.to_json() for result in self.results],
        }


def study_perception(
    subject: Subject,
    models: Sequence[StudiedModel],
    conditions: Sequence[Condition],
    *,
    seed: int = 0,
    calls: Path | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> PerceptionStudy:
    """Let every model read the same pictures under every condition.

    Args:
        subject: predicates and pictures.
        models: who reads.
        conditions: how pictures are shown; those that the subject cannot show are left out.
        seed: of the embedded model.
        calls: a store in which calls are kept and found again; None for none.
        progress: told what is done next.

    Raises:
        ProviderError: if a model does not answer.
    """
    shown = [condition for condition in conditions if subject.supports(condition)]
    results, pictures, domain = [], 0, subject.package.reference
    for condition in shown:
        samples = subject.samples(condition)
        pictures = len(samples)
        for model in models:
            progress(f"{condition.name}: {model.label}")
            with open_studied(model, domain, seed=seed, calls=calls) as assistant:
                scores, clean = _read(subject, samples, assistant)
            results.append(ConditionResult(model, condition, scores, clean))
    left_out = tuple(c.name for c in conditions if c not in shown)
    published = subject.published.perception
    return PerceptionStudy(subject.origin, pictures, tuple(results), left_out, published)


def _read(
    subject: Subject, samples: Sequence[Sample], assistant: Assistant
) -> tuple[tuple[PredicateScore, ...], float | None]:
    """How every predicate is read, and the share of pictures in which nothing is misread."""
    questions = [
        EvaluationQuestion(subject.domain, subject.objects, s.observation, subject.predicates)
        for s in samples
    ]
    readings = [answer.labels for answer in assistant.evaluate(questions)]
    truths = [sample.truth for sample in samples]
    scores = tuple(
        score_predicate(predicate, subject.objects, truths, readings)
        for predicate in subject.predicates
    )
    return scores, share_clean(truths, readings)

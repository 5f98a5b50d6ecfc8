"""A noise profile out of a study: how a model misread pictures whose truth is known."""

from __future__ import annotations

from skillwrapper.embedded.noise import NoiseProfile
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.study.perception import ConditionResult, PerceptionStudy
from skillwrapper.evaluation.study.scoring import PredicateScore
from skillwrapper.runs.estimated_noise import CountedErrors, profile_of


def profile_of_study(study: PerceptionStudy) -> NoiseProfile:
    """The profile of the one model and the one condition of a study.

    Raises:
        ConfigurationError: if there are several, or nothing was read.
    """
    if len(study.results) != 1:
        raise ConfigurationError(
            f"a noise profile: expected one model and one condition, got {len(study.results)} "
            "results; name them with --model and --conditions"
        )
    (result,) = study.results
    if result.clean is None:
        raise ConfigurationError("a noise profile: expected pictures that were read, got none")
    source = (
        f"{result.model.label} on {study.pictures} pictures ({result.condition.name}), beside the "
        f"truth; predicates: {study.origin}"
    )
    return profile_of(_counted(result), 1 - result.clean, source)


def _counted(result: ConditionResult) -> list[CountedErrors]:
    return [_errors(score) for score in result.scores]


def _errors(score: PredicateScore) -> CountedErrors:
    """What was left unknown is no error; it is not counted at all."""
    return CountedErrors(
        score.predicate,
        score.arity,
        positives=score.true - score.unknown_true,
        false_negatives=score.false_negatives,
        negatives=score.readings - score.true - (score.unknown - score.unknown_true),
        false_positives=score.false_positives,
    )

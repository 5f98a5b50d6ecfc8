"""Noise profiles out of counted errors: how a model misread pictures, as estimated or as known."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import yaml

from skillwrapper.embedded.facts import Sort
from skillwrapper.embedded.noise import ErrorRates, FactErrors, NoiseProfile
from skillwrapper.runs.archive.records import DecodingRecord, ErrorRatesRecord
from skillwrapper.symbols import Predicate

_MOST_CLEAN = 0.99


@dataclass(frozen=True)
class CountedErrors:
    """How often a predicate was misread.

    Attributes:
        name: of the predicate.
        arity: number of its parameters.
        positives: readings of atoms that were true.
        false_negatives: how many of those were read as false.
        negatives: readings of atoms that were false.
        false_positives: how many of those were read as true.
    """

    name: str
    arity: int
    positives: int
    false_negatives: int
    negatives: int
    false_positives: int


def profile_of(counted: Iterable[CountedErrors], dirty: float, source: str) -> NoiseProfile:
    """The profile of counted errors.

    Predicates stand for facts: those of one object for attributes, those of several for relations.

    Args:
        counted: the errors of every predicate.
        dirty: the share of pictures in which something was misread.
        source: where the figures come from.
    """
    facts = tuple(map(_errors, counted))
    wrong_true = sum(f.false_negatives for f in facts)
    wrong_false = sum(f.false_positives for f in facts)
    return NoiseProfile(
        source=source,
        clean_pictures=round(min(_MOST_CLEAN, 1 - dirty), 3),
        facts=facts,
        other=ErrorRates(
            false_negative=round(wrong_true / max(1, sum(f.positives for f in facts)), 4),
            false_positive=round(wrong_false / max(1, sum(f.negatives for f in facts)), 4),
        ),
    )


def estimate_profile(
    decoding: DecodingRecord, predicates: tuple[Predicate, ...], source: str
) -> NoiseProfile:
    """The profile of a run's readings, estimated without the truth.

    Args:
        decoding: what was made of the readings.
        predicates: the vocabulary.
        source: where the figures come from.
    """
    found = [(p, decoding.rates_of(p.name)) for p in predicates]
    counted = (_estimated(p, rates) for p, rates in found if rates is not None)
    return profile_of(counted, decoding.dirty, source)


def print_profile(profile: NoiseProfile) -> str:
    """The profile as YAML, as ``--noise FILE`` takes it."""
    data = profile.model_dump(mode="json", exclude={"name"}, exclude_defaults=True)
    return yaml.safe_dump(data, sort_keys=False, allow_unicode=True)


def _estimated(predicate: Predicate, rates: ErrorRatesRecord) -> CountedErrors:
    positives, negatives = round(rates.positives), round(rates.negatives)
    return CountedErrors(
        predicate.name,
        predicate.arity,
        positives=positives,
        false_negatives=round(rates.false_negative * positives),
        negatives=negatives,
        false_positives=round(rates.false_positive * negatives),
    )


def _errors(counted: CountedErrors) -> FactErrors:
    return FactErrors(
        sort=(Sort.CONDITION, Sort.ATTRIBUTE, Sort.RELATION)[min(2, counted.arity)],
        name=counted.name,
        positives=counted.positives,
        false_negatives=counted.false_negatives,
        negatives=counted.negatives,
        false_positives=counted.false_positives,
    )

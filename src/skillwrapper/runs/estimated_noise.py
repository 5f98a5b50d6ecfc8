"""A noise profile out of a run: how its model misread pictures, as estimated without the truth."""

from __future__ import annotations

import yaml

from skillwrapper.embedded.facts import Sort
from skillwrapper.embedded.noise import ErrorRates, FactErrors, NoiseProfile
from skillwrapper.runs.archive.records import DecodingRecord, ErrorRatesRecord
from skillwrapper.symbols import Predicate

_MOST_CLEAN = 0.99


def estimate_profile(
    decoding: DecodingRecord, predicates: tuple[Predicate, ...], source: str
) -> NoiseProfile:
    """The profile of a run's readings.

    Predicates stand for facts: those of one object for attributes, those of several for relations.

    Args:
        decoding: what was made of the readings.
        predicates: the vocabulary.
        source: where the figures come from.
    """
    found = [(p, decoding.rates_of(p.name)) for p in predicates]
    facts = tuple(_errors(p, rates) for p, rates in found if rates is not None)
    wrong_true = sum(f.false_negatives for f in facts)
    wrong_false = sum(f.false_positives for f in facts)
    return NoiseProfile(
        source=source,
        clean_pictures=round(min(_MOST_CLEAN, 1 - decoding.dirty), 3),
        facts=facts,
        other=ErrorRates(
            false_negative=round(wrong_true / max(1, sum(f.positives for f in facts)), 4),
            false_positive=round(wrong_false / max(1, sum(f.negatives for f in facts)), 4),
        ),
    )


def print_profile(profile: NoiseProfile) -> str:
    """The profile as YAML, as ``--noise FILE`` takes it."""
    data = profile.model_dump(mode="json", exclude={"name"}, exclude_defaults=True)
    return yaml.safe_dump(data, sort_keys=False, allow_unicode=True)


def _errors(predicate: Predicate, rates: ErrorRatesRecord) -> FactErrors:
    positives, negatives = round(rates.positives), round(rates.negatives)
    sort = (Sort.CONDITION, Sort.ATTRIBUTE, Sort.RELATION)[min(2, predicate.arity)]
    return FactErrors(
        sort=sort,
        name=predicate.name,
        positives=positives,
        false_negatives=round(rates.false_negative * positives),
        negatives=negatives,
        false_positives=round(rates.false_positive * negatives),
    )

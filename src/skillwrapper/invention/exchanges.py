"""Exchanges: a dormant predicate for an active one, where that leaves less inconsistent.

What was accepted first, on few data, may be a poor likeness of what came later: a robot that looks
larger than a station most often holds something. As long as the likeness is in use, what it
resembles seems superfluous, and is set dormant; when it errs, no further predicate helps.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.symbols import Predicate


@dataclass(frozen=True)
class Exchange:
    """Two predicates that change places.

    Attributes:
        dormant: was active.
        active: was dormant.
    """

    dormant: Predicate
    active: Predicate


def find_exchange(
    fitter: Fitter, vocabulary: Vocabulary, inconsistency: Inconsistency
) -> Exchange | None:
    """The exchange that leaves least inconsistent, and then costs least.

    Args:
        fitter: learns operators, and holds the data.
        vocabulary: the predicates; what was taken for a change alone (D26) stays.
        inconsistency: what is to be resolved.

    Returns:
        None if no exchange resolves it and leaves less inconsistent in all.
    """
    present = len(fitter.fit(vocabulary.active).witnesses)
    found: Exchange | None = None
    lowest: tuple[float, float] = (present, 0.0)
    for exchange in _exchanges(vocabulary):
        fit = fitter.fit(_after(vocabulary, exchange))
        if _resolves(fit, inconsistency):
            rank = len(fit.witnesses), fit.cost
            if rank < lowest:
                found, lowest = exchange, rank
    return found


def _exchanges(vocabulary: Vocabulary) -> Iterator[Exchange]:
    for old in vocabulary.active:
        if old.name not in vocabulary.changes:
            for new in vocabulary.dormant:
                yield Exchange(old, new)


def _after(vocabulary: Vocabulary, exchange: Exchange) -> list[Predicate]:
    return [*(p for p in vocabulary.active if p != exchange.dormant), exchange.active]


def _resolves(fit: Fit, inconsistency: Inconsistency) -> bool:
    return inconsistency.witness not in fit.skill(inconsistency.skill).witnesses

"""What becomes of candidate predicates."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.symbols import Predicate


class Verdict(StrEnum):
    """What became of a candidate predicate."""

    ACCEPTED = "accepted"
    REVIVED = "revived"
    REJECTED = "rejected"
    RETRACTED = "retracted"


@dataclass(frozen=True)
class CandidateDecision:
    """What was decided of one candidate, and why.

    Attributes:
        verdict: what became of it.
        predicate: the candidate.
        reason: for people.
        inconsistency: what it was asked for; None if it was asked for nothing in particular.
        score: its score on the transitions of the inconsistency's skill, 0 to 1; None if it
            was rejected before all pictures were labelled, or if no transition is decided.
    """

    verdict: Verdict
    predicate: Predicate
    reason: str
    inconsistency: Inconsistency | None = None
    score: float | None = None

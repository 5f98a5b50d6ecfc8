"""Decisions on predicates as a run keeps them: of candidates, and of what is set dormant."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.pruning import Pruned
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.symbols import Predicate
from skillwrapper.world.episode import Transition

DORMANT = "dormant"


@dataclass(frozen=True)
class NumberedTransition:
    """A transition with its number among all of a run, from 0."""

    number: int
    transition: Transition


@dataclass(frozen=True)
class PredicateDecision:
    """What was decided of a predicate.

    Attributes:
        verdict: accepted, revived, rejected, retracted or dormant.
        predicate: the predicate.
        reason: why, for people.
        score: 0 to 1; None if there is none.
        inconsistency: what it was asked for; None if for nothing.
        witnesses: the transitions that the inconsistency speaks of.
    """

    verdict: str
    predicate: Predicate
    reason: str
    score: float | None = None
    inconsistency: Inconsistency | None = None
    witnesses: tuple[NumberedTransition, ...] = field(default=(), repr=False)

    @classmethod
    def of_candidate(
        cls, decision: CandidateDecision, transitions: Sequence[Transition]
    ) -> PredicateDecision:
        """What invention decided.

        Args:
            decision: the decision.
            transitions: all of the run.
        """
        asked_for = decision.inconsistency
        return cls(
            str(decision.verdict),
            decision.predicate,
            decision.reason,
            decision.score,
            asked_for,
            witnesses_of(asked_for, transitions) if asked_for else (),
        )

    @classmethod
    def of_pruned(cls, pruned: Pruned) -> Iterator[PredicateDecision]:
        """What pruning took out of use, and what it put in its place."""
        if pruned.instead is None:
            yield cls(DORMANT, pruned.predicate, pruned.reason)
        else:
            yield cls(str(Verdict.RETRACTED), pruned.predicate, pruned.reason)
            yield cls(str(Verdict.ACCEPTED), pruned.instead, pruned.reason)


def witnesses_of(
    inconsistency: Inconsistency, transitions: Sequence[Transition]
) -> tuple[NumberedTransition, ...]:
    """The transitions that an inconsistency speaks of."""
    numbers = (inconsistency.first, inconsistency.second)
    return tuple(NumberedTransition(n, transitions[n]) for n in numbers if n is not None)

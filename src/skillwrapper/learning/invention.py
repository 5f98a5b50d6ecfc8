"""Predicate invention (the paper's Algorithm 4): as long as data and model disagree, ask for a
predicate, keep it if it helps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from skillwrapper.learning.clusters import changed_literals
from skillwrapper.learning.fitting import Fit, Fitter
from skillwrapper.learning.inconsistencies import Identity, Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.lifted_states import lifted_state
from skillwrapper.learning.lifting import lift_change
from skillwrapper.learning.pruning import find_burden
from skillwrapper.learning.settings import LearningSettings
from skillwrapper.learning.vocabulary import Vocabulary
from skillwrapper.symbols import AtomSpace, Labels, Predicate

_ORDER = list(InconsistencyKind)


class Proposer(Protocol):
    """Who proposes predicates; the learner knows nothing of models or prompts."""

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> Sequence[Predicate]:
        """Candidates that may tell the two transitions apart; may be empty."""
        ...


class Verdict(StrEnum):
    """What became of a candidate predicate."""

    ACCEPTED = "accepted"
    REVIVED = "revived"
    REJECTED = "rejected"
    RETRACTED = "retracted"


@dataclass(frozen=True)
class Decision:
    """What was decided of one candidate, and why.

    Attributes:
        verdict: what became of it.
        predicate: the candidate.
        inconsistency: what it was asked for; None for a retracted one.
        score: its score on the transitions of the inconsistency's skill, 0 to 1; None if it
            was rejected before all pictures were labelled.
        reason: for people.
    """

    verdict: Verdict
    predicate: Predicate
    inconsistency: Inconsistency | None
    score: float | None
    reason: str


@dataclass(frozen=True)
class _Trial:
    predicate: Predicate
    dormant: bool
    fit: Fit
    score: float
    resolved: bool

    def rank(self, position: int) -> tuple[int, int, int, int]:
        """Smaller is better: what is left of conditions 1 and 2 and the operators that it takes,
        what is left of the other kinds, the number of groundings to evaluate."""
        kinds = Counter(w[0] for w in self.fit.witnesses)
        hard = kinds[InconsistencyKind.PRECONDITION] + kinds[InconsistencyKind.EFFECT]
        soft = sum(kinds.values()) - hard
        return hard + len(self.fit.operators), soft, self.predicate.arity, position


class Inventor:
    """Invents predicates for a growing data set.

    Args:
        fitter: learns operators for vocabularies.
        vocabulary: the predicates; changed in place.
        proposer: who is asked.
        settings: thresholds and bounds.
        listener: told of every decision as it is taken.
    """

    def __init__(
        self,
        fitter: Fitter,
        vocabulary: Vocabulary,
        proposer: Proposer,
        settings: LearningSettings,
        listener: Callable[[Decision], None] = lambda decision: None,
    ) -> None:
        self._listener = listener
        self._fitter = fitter
        self._vocabulary = vocabulary
        self._proposer = proposer
        self._settings = settings
        self._attempts: Counter[Identity] = Counter()

    def invent(self) -> Fit:
        """Invent until nothing is inconsistent or every inconsistency was tried often enough.

        A predicate that splits the data into more operators than it explains transitions is
        taken back, once in a call, and what it explained is asked for again.
        """
        retracted: set[Predicate] = set()
        for _ in range(self._settings.max_inventions):
            fit = self._fitter.fit(self._vocabulary.active)
            inconsistency = self._next(fit)
            if inconsistency is not None:
                self._resolve(inconsistency, fit)
                continue
            burden = find_burden(self._fitter, self._vocabulary, retracted)
            if burden is None:
                break
            retracted.add(burden)
            self._retract(burden)
        return self._fitter.fit(self._vocabulary.active)

    def unresolved(self, fit: Fit) -> tuple[Inconsistency, ...]:
        """One inconsistency for each cause that is left."""
        return distinct_causes(fit.inconsistencies)

    def _next(self, fit: Fit) -> Inconsistency | None:
        """The cause tried least; conditions 1 and 2 before determinism and unexplained changes."""
        tries = self._settings.attempts
        left = [
            c for c in distinct_causes(fit.inconsistencies) if self._attempts[c.identity] < tries
        ]
        return min(
            left,
            key=lambda c: (self._attempts[c.identity], _ORDER.index(c.kind)),
            default=None,
        )

    def _retract(self, predicate: Predicate) -> None:
        self._vocabulary.retract(predicate)
        self._attempts.clear()
        reason = "it takes more operators than it explains transitions"
        self._listener(Decision(Verdict.RETRACTED, predicate, None, None, reason))

    def _resolve(self, inconsistency: Inconsistency, fit: Fit) -> bool:
        attempt = self._attempts[inconsistency.identity]
        self._attempts[inconsistency.identity] += 1
        if attempt == 0 and self._try(inconsistency, self._vocabulary.dormant, dormant=True):
            return True
        proposed = self._proposer.propose(
            inconsistency, fit.predicates, self._vocabulary.rejected, attempt
        )
        fresh = self._vocabulary.fresh(proposed)
        return self._try(inconsistency, fresh, dormant=False)

    def _try(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate], *, dormant: bool
    ) -> bool:
        """Keep the best of the candidates that resolve the inconsistency, if any does."""
        promising = list(self._screen(inconsistency, candidates, dormant=dormant))
        self._label(promising)
        trials = [self._trial(inconsistency, p, dormant=dormant) for p in promising]
        good = [
            (t.rank(n), t)
            for n, t in enumerate(trials)
            if t.resolved and t.score > self._settings.threshold
        ]
        best = min(good, key=lambda pair: pair[0])[1] if good else None
        for trial in trials:
            self._record(inconsistency, trial, best)
        if best is not None:
            self._vocabulary.accept(best.predicate)
        return best is not None

    def _screen(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate], *, dormant: bool
    ) -> Iterator[Predicate]:
        """Ask for the witnesses' pictures first: who cannot tell them apart needs no more."""
        for predicate in candidates:
            if self._separates(inconsistency, predicate):
                yield predicate
            elif not dormant:
                self._vocabulary.reject(predicate)
                self._listener(
                    Decision(
                        Verdict.REJECTED,
                        predicate,
                        inconsistency,
                        None,
                        "does not tell the two transitions apart",
                    )
                )

    def _separates(self, inconsistency: Inconsistency, predicate: Predicate) -> bool:
        views = [
            self._view(number, predicate, inconsistency.kind)
            for number in (inconsistency.first, inconsistency.second)
            if number is not None
        ]
        return views[0] != views[1] if len(views) == 2 else bool(views[0])

    def _view(self, number: int, predicate: Predicate, kind: InconsistencyKind) -> object:
        """A transition as the predicate alone shows it: its start, or its change."""
        record = self._fitter.dataset.records[number]
        space = AtomSpace((predicate,), self._fitter.dataset.objects(record.scene))
        transition = record.transition
        instance = transition.instance
        if kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.DETERMINISM):
            start = self._fitter.truth.labels(space, [transition.before])
            return lifted_state(space, start[0], instance)
        labels = self._fitter.truth.labels(space, [transition.before, transition.after])
        change: Labels = (labels[1] - labels[0]) * (labels >= 0).all(axis=0)
        return lift_change(changed_literals(space, change), instance.arguments).change

    def _label(self, predicates: Sequence[Predicate]) -> None:
        """Label all pictures for all candidates in one go."""
        dataset = self._fitter.dataset
        if predicates:
            for scene in dataset.scenes:
                space = AtomSpace(tuple(predicates), dataset.objects(scene))
                self._fitter.truth.labels(space, dataset.observations(scene))

    def _trial(
        self, inconsistency: Inconsistency, predicate: Predicate, *, dormant: bool
    ) -> _Trial:
        fit = self._fitter.fit(self._vocabulary.with_candidate(predicate))
        score = fit.skills[inconsistency.skill].score(inconsistency.kind)
        resolved = inconsistency.witness not in fit.witnesses
        return _Trial(predicate, dormant, fit, score, resolved)

    def _record(self, inconsistency: Inconsistency, trial: _Trial, best: _Trial | None) -> None:
        if trial is best:
            verdict = Verdict.REVIVED if trial.dormant else Verdict.ACCEPTED
            reason = "resolves the inconsistency"
        else:
            verdict = Verdict.REJECTED
            if not trial.resolved:
                reason = "the inconsistency remains"
            elif trial.score <= self._settings.threshold:
                reason = f"score {trial.score:.2f} is not above {self._settings.threshold:.2f}"
            else:
                reason = "another candidate leaves less unexplained"
            if not trial.dormant:
                self._vocabulary.reject(trial.predicate)
        self._listener(Decision(verdict, trial.predicate, inconsistency, trial.score, reason))

"""Predicate invention (the paper's Algorithm 4): as long as data and model disagree, ask for a
predicate, keep it if it helps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol

from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.pruning import find_burdens
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.trials import Trial
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.invention.witnesses import Witnesses
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Identity, Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate

_ORDER = list(InconsistencyKind)
_BURDEN = "it takes more operators than it explains transitions"


class Proposer(Protocol):
    """Who proposes predicates; the inventor knows nothing of models or prompts."""

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> Sequence[Predicate]:
        """Candidates that may tell the two transitions apart; may be empty."""
        ...


class Inventor:
    """Invents predicates while transitions are added.

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
        listener: Callable[[CandidateDecision], None] = lambda decision: None,
    ) -> None:
        self._listener = listener
        self._fitter = fitter
        self._vocabulary = vocabulary
        self._proposer = proposer
        self._settings = settings
        self._executions: dict[str, int] = {}
        self._attempts: Counter[Identity] = Counter()
        self._questions: Counter[Identity] = Counter()
        self._postponed: dict[Identity, tuple[Predicate, ...]] = {}

    def invent(self) -> Fit:
        """Invent until nothing is inconsistent or every inconsistency was tried often enough.

        A predicate that splits the data into more operators than it explains transitions is
        taken back, once in a call, and what it explained is asked for again.
        """
        self._admit_new_data()
        retracted: set[Predicate] = set()
        for _ in range(self._settings.max_inventions):
            fit = self._fitter.fit(self._vocabulary.active)
            inconsistency = self._next(fit)
            if inconsistency is not None:
                self._resolve(inconsistency, fit)
                continue
            burdens = find_burdens(self._fitter, self._vocabulary, retracted)
            if not burdens:
                break
            retracted.update(burdens)
            self._retract(burdens)
        return self._fitter.fit(self._vocabulary.active)

    def _admit_new_data(self) -> None:
        """What was given up or rejected on fewer data may be tried again.

        What was given up of a skill that was not run since is not: the model would be asked the
        same question about the same pictures.
        """
        executions = self._fitter.recorded.count_by_skill()
        new = {name for name in executions if executions[name] != self._executions.get(name)}
        if new:
            self._executions = executions
            for identity in [i for i in self._attempts if i[0] in new]:
                del self._attempts[identity]
            self._postponed.clear()
            self._vocabulary.forget_rejections()

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

    def _retract(self, predicates: Sequence[Predicate]) -> None:
        self._vocabulary.retract(predicates)
        self._attempts.clear()
        for predicate in predicates:
            self._listener(CandidateDecision(Verdict.RETRACTED, predicate, _BURDEN))

    def _resolve(self, inconsistency: Inconsistency, fit: Fit) -> None:
        """Look for a predicate among the dormant ones, then among those that the model proposes.

        A candidate that takes more than it explains is postponed; the last attempt takes the
        best of all that were postponed if nothing better came, unless it takes much more: then
        the inconsistency is better left open until there are more data.
        """
        attempt = self._attempts[inconsistency.identity]
        self._attempts[inconsistency.identity] += 1
        if attempt == 0 and self._try(inconsistency, fit, self._vocabulary.dormant, dormant=True):
            return
        number = self._questions[inconsistency.identity]
        self._questions[inconsistency.identity] += 1
        proposed = self._proposer.propose(
            inconsistency, fit.predicates, self._vocabulary.rejected, number
        )
        fresh = self._vocabulary.fresh(proposed)
        if self._try(inconsistency, fit, fresh, dormant=False):
            return
        postponed = self._postponed.get(inconsistency.identity, ())
        if attempt + 1 >= self._settings.attempts and postponed:
            self._take_best(inconsistency, postponed)

    def _try(
        self,
        inconsistency: Inconsistency,
        fit: Fit,
        candidates: Sequence[Predicate],
        *,
        dormant: bool,
    ) -> bool:
        """Keep the best of the candidates that resolve the inconsistency, if it is worth it."""
        promising = list(self._screen(inconsistency, candidates, dormant=dormant))
        self._fitter.labeller.label(promising)  # all pictures for all candidates in one go
        trials = [self._trial(inconsistency, p, dormant=dormant) for p in promising]
        good = [t for t in trials if not t.shortcoming(self._settings.threshold)]
        worth = [t for t in good if t.is_worth_it(fit, inconsistency.kind)]
        best = min(worth, key=Trial.rank, default=None)
        for trial in trials:
            self._record(inconsistency, trial, best, worth)
        if best is not None:
            self._accept(best)
        else:
            known = self._postponed.get(inconsistency.identity, ())
            self._postponed[inconsistency.identity] = (*known, *(t.predicate for t in good))
        return best is not None

    def _take_best(self, inconsistency: Inconsistency, postponed: Sequence[Predicate]) -> None:
        fit, kind = self._fitter.fit(self._vocabulary.active), inconsistency.kind
        asleep = self._vocabulary.dormant
        trials = [self._trial(inconsistency, p, dormant=p in asleep) for p in postponed]
        resolving = [t for t in trials if not t.remains and not t.undecided]
        worth = [t for t in resolving if t.is_worth_it(fit, kind, slack=1)]
        best = min(worth, key=Trial.rank, default=None)
        if best is not None:
            reason = "the best that came for an inconsistency"
            self._decide(_acceptance(best), inconsistency, best, reason)
            self._accept(best)

    def _accept(self, trial: Trial) -> None:
        self._vocabulary.accept(trial.predicate)
        self._postponed.clear()

    def _screen(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate], *, dormant: bool
    ) -> Iterator[Predicate]:
        """Ask for the witnesses' pictures first: who cannot tell them apart needs no more."""
        witnesses = Witnesses(self._fitter.labeller, inconsistency)
        witnesses.look(candidates)
        reason = "does not tell the two transitions apart"
        for predicate in candidates:
            if witnesses.are_told_apart(predicate):
                yield predicate
            elif not dormant:
                self._vocabulary.reject(predicate)
                self._listener(
                    CandidateDecision(Verdict.REJECTED, predicate, reason, inconsistency)
                )

    def _trial(self, inconsistency: Inconsistency, predicate: Predicate, *, dormant: bool) -> Trial:
        before = self._fitter.fit(self._vocabulary.active)
        fit = self._fitter.fit(self._vocabulary.with_candidate(predicate))
        return Trial.of(predicate, inconsistency, dormant=dormant, before=before, fit=fit)

    def _record(
        self,
        inconsistency: Inconsistency,
        trial: Trial,
        best: Trial | None,
        worth: Sequence[Trial],
    ) -> None:
        if trial is best:
            self._decide(_acceptance(trial), inconsistency, trial, "resolves the inconsistency")
            return
        reason = trial.shortcoming(self._settings.threshold)
        if not reason:
            reason = "another candidate leaves less unexplained" if trial in worth else _BURDEN
        if not trial.dormant:
            self._vocabulary.reject(trial.predicate)
        self._decide(Verdict.REJECTED, inconsistency, trial, reason)

    def _decide(
        self, verdict: Verdict, inconsistency: Inconsistency, trial: Trial, reason: str
    ) -> None:
        self._listener(
            CandidateDecision(verdict, trial.predicate, reason, inconsistency, trial.score)
        )


def _acceptance(trial: Trial) -> Verdict:
    return Verdict.REVIVED if trial.dormant else Verdict.ACCEPTED

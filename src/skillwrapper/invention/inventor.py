"""Predicate invention (the paper's Algorithm 4): as long as data and model disagree, ask for a
predicate, keep it if it helps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from skillwrapper.grounding import UNKNOWN, AtomSpace, Labels
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.pruning import find_burdens
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.fitting import OPERATOR_COST, Fit, SkillFit
from skillwrapper.learning.inconsistencies import Identity, Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.lifted_states import LiftedState, lifted_state
from skillwrapper.symbols import Literal, Predicate
from skillwrapper.transitions.lifting import LiftedChange, lift_change
from skillwrapper.transitions.tables import changed_literals

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
class CandidateDecision:
    """What was decided of one candidate, and why.

    Attributes:
        verdict: what became of it.
        predicate: the candidate.
        inconsistency: what it was asked for; None for a retracted one.
        score: its score on the transitions of the inconsistency's skill, 0 to 1; None if it
            was rejected before all pictures were labelled, or if no transition is decided.
        reason: for people.
    """

    verdict: Verdict
    predicate: Predicate
    inconsistency: Inconsistency | None
    score: float | None
    reason: str


@dataclass(frozen=True, eq=False)
class _Trial:
    """A candidate with the model that would be learned with it."""

    predicate: Predicate
    dormant: bool
    fit: Fit
    score: float | None
    remains: bool
    undecided: bool

    @property
    def resolved(self) -> bool:
        """Whether the inconsistency is gone, and not for want of a label."""
        return not self.remains and not self.undecided

    def rank(self, position: int) -> tuple[int, int, int, int]:
        """Smaller is better: what is left of conditions 1 and 2 and the operators that it takes,
        what is left of the other kinds, the number of groundings to evaluate."""
        everything = self.fit.cost
        return self.fit.hard_cost, everything, self.predicate.arity, position

    def is_worth_it(self, before: Fit, kind: InconsistencyKind, slack: int = 0) -> bool:
        """Whether it explains at least as much as it takes, but for ``slack`` operators.

        What it leaves of the third and fourth kind counts only if one of these was asked for:
        a good relation often has to wait for its partner (D6).
        """
        allowed = slack * OPERATOR_COST
        if kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT):
            return self.fit.hard_cost <= before.hard_cost + allowed
        return self.fit.cost <= before.cost + allowed


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
        listener: Callable[[CandidateDecision], None] = lambda decision: None,
    ) -> None:
        self._listener = listener
        self._fitter = fitter
        self._vocabulary = vocabulary
        self._proposer = proposer
        self._settings = settings
        self._size = 0
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
        """What was given up or rejected on fewer data may be tried again."""
        size = len(self._fitter.recorded)
        if size != self._size:
            self._size = size
            self._attempts.clear()
            self._postponed.clear()
            self._vocabulary.forget_rejections()

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

    def _retract(self, predicates: Sequence[Predicate]) -> None:
        self._vocabulary.retract(predicates)
        self._attempts.clear()
        reason = "it takes more operators than it explains transitions"
        for predicate in predicates:
            self._listener(CandidateDecision(Verdict.RETRACTED, predicate, None, None, reason))

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
            self._take_best(inconsistency, fit, postponed)

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
        self._label(promising)
        trials = [self._trial(inconsistency, p, dormant=dormant) for p in promising]
        good = [t for t in trials if t.resolved and self._scores(t)]
        worth = [t for t in good if t.is_worth_it(fit, inconsistency.kind)]
        best = self._best(worth)
        for trial in trials:
            self._record(inconsistency, trial, best, worth)
        if best is not None:
            self._accept(best)
        else:
            known = self._postponed.get(inconsistency.identity, ())
            self._postponed[inconsistency.identity] = (*known, *(t.predicate for t in good))
        return best is not None

    def _scores(self, trial: _Trial) -> bool:
        return trial.score is not None and trial.score > self._settings.threshold

    def _take_best(
        self, inconsistency: Inconsistency, fit: Fit, postponed: Sequence[Predicate]
    ) -> None:
        asleep = self._vocabulary.dormant
        trials = [self._trial(inconsistency, p, dormant=p in asleep) for p in postponed]
        kind = inconsistency.kind
        best = self._best([t for t in trials if t.resolved and t.is_worth_it(fit, kind, slack=1)])
        if best is not None:
            verdict = Verdict.REVIVED if best.dormant else Verdict.ACCEPTED
            reason = "the best that came for an inconsistency"
            self._listener(
                CandidateDecision(verdict, best.predicate, inconsistency, best.score, reason)
            )
            self._accept(best)

    def _best(self, trials: Sequence[_Trial]) -> _Trial | None:
        ranked = sorted(range(len(trials)), key=lambda n: trials[n].rank(n))
        return trials[ranked[0]] if ranked else None

    def _accept(self, trial: _Trial) -> None:
        self._vocabulary.accept(trial.predicate)
        self._postponed.clear()

    def _screen(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate], *, dormant: bool
    ) -> Iterator[Predicate]:
        """Ask for the witnesses' pictures first: who cannot tell them apart needs no more."""
        self._look_at_witnesses(inconsistency, candidates)
        for predicate in candidates:
            if self._separates(inconsistency, predicate):
                yield predicate
            elif not dormant:
                self._vocabulary.reject(predicate)
                self._listener(
                    CandidateDecision(
                        Verdict.REJECTED,
                        predicate,
                        inconsistency,
                        None,
                        "does not tell the two transitions apart",
                    )
                )

    def _look_at_witnesses(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate]
    ) -> None:
        """Have the witnesses' pictures labelled for all candidates in one go."""
        recorded = self._fitter.recorded
        changes = inconsistency.second is None or inconsistency.kind is InconsistencyKind.EFFECT
        wanted = []
        for number in (inconsistency.first, inconsistency.second):
            if number is not None and candidates:
                record = recorded.records[number]
                space = AtomSpace(tuple(candidates), record.scene.objects)
                moments = [record.transition.before]
                if changes:
                    moments.append(record.transition.after)
                wanted.append((space, moments))
        self._fitter.labeller.truth.prefetch(wanted)

    def _separates(self, inconsistency: Inconsistency, predicate: Predicate) -> bool:
        first, second = inconsistency.first, inconsistency.second
        if second is None:
            things = {term for atom in inconsistency.unexplained for term in atom.terms}
            changed = self._changed(first, predicate)
            return any(things.intersection(literal.atom.terms) for literal in changed)
        if inconsistency.kind is InconsistencyKind.EFFECT:
            return self._lifted_change(first, predicate) != self._lifted_change(second, predicate)
        return self._start(first, predicate) != self._start(second, predicate)

    def _start(self, number: int, predicate: Predicate) -> LiftedState:
        """The start of a transition as the predicate alone shows it."""
        record = self._fitter.recorded.records[number]
        space = AtomSpace((predicate,), record.scene.objects)
        labels = self._fitter.labeller.truth.labels(space, [record.transition.before])
        return lifted_state(space, labels[0], record.transition.instance)

    def _lifted_change(self, number: int, predicate: Predicate) -> LiftedChange:
        """The change around the arguments as the predicate alone shows it."""
        arguments = self._fitter.recorded.records[number].transition.instance.arguments
        return lift_change(self._changed(number, predicate), arguments).change

    def _changed(self, number: int, predicate: Predicate) -> list[Literal]:
        """What is known to have changed, as the predicate alone shows it."""
        record = self._fitter.recorded.records[number]
        space = AtomSpace((predicate,), record.scene.objects)
        pictures = [record.transition.before, record.transition.after]
        labels = self._fitter.labeller.truth.labels(space, pictures)
        change: Labels = (labels[1] - labels[0]) * (labels != UNKNOWN).all(axis=0)
        return changed_literals(space, change)

    def _label(self, predicates: Sequence[Predicate]) -> None:
        """Label all pictures for all candidates in one go."""
        self._fitter.labeller.label(predicates)

    def _trial(
        self, inconsistency: Inconsistency, predicate: Predicate, *, dormant: bool
    ) -> _Trial:
        fit = self._fitter.fit(self._vocabulary.with_candidate(predicate))
        skill = fit.skill(inconsistency.skill)
        return _Trial(
            predicate,
            dormant,
            fit,
            skill.score(inconsistency.kind),
            remains=inconsistency.witness in skill.witnesses,
            undecided=not self._decides_one(inconsistency, skill),
        )

    def _decides_one(self, inconsistency: Inconsistency, fit: SkillFit) -> bool:
        """Whether a transition of the same cause is no longer wrong and hangs on no unknown."""
        now = self._fitter.fit(self._vocabulary.active).skill(inconsistency.skill)
        return any(
            i.witness not in fit.witnesses and i.culprit not in fit.undecided
            for i in now.inconsistencies
            if i.identity == inconsistency.identity
        )

    def _record(
        self,
        inconsistency: Inconsistency,
        trial: _Trial,
        best: _Trial | None,
        worth: Sequence[_Trial],
    ) -> None:
        if trial is best:
            verdict = Verdict.REVIVED if trial.dormant else Verdict.ACCEPTED
            reason = "resolves the inconsistency"
        else:
            verdict = Verdict.REJECTED
            if trial.remains:
                reason = "the inconsistency remains"
            elif trial.undecided:
                reason = "its labels of what is inconsistent are unknown"
            elif trial.score is None:
                reason = "no transition is decided with it"
            elif not self._scores(trial):
                reason = f"score {trial.score:.2f} is not above {self._settings.threshold:.2f}"
            elif trial not in worth:
                reason = "it takes more operators than it explains transitions"
            else:
                reason = "another candidate leaves less unexplained"
            if not trial.dormant:
                self._vocabulary.reject(trial.predicate)
        self._listener(
            CandidateDecision(verdict, trial.predicate, inconsistency, trial.score, reason)
        )

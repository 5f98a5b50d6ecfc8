"""Predicate invention (the paper's Algorithm 4): as long as data and model disagree, ask for a
predicate, keep it if it helps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from typing import Protocol

from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.exchanges import find_exchange
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.look_alikes import LookAlikes
from skillwrapper.invention.pruning import find_burdens, follows
from skillwrapper.invention.rejections import Rejections
from skillwrapper.invention.ripeness import Ripeness
from skillwrapper.invention.screening import NOTHING_NEW, UNSTEADY, Screen
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.steadiness import Steadiness
from skillwrapper.invention.trials import Trial
from skillwrapper.invention.unnoticed import Shelf, UnnoticedChanges
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Identity, Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

_ORDER = list(InconsistencyKind)
_TELLING = "it tells apart what nothing else does"
_BURDEN = "it takes more operators than it explains transitions"
_FAR_LESS = 2 / 3
_MANY = 5.0
"""A model is far better than another one if it costs at most this share, and so many less."""
_SELDOM = 0.005
"""Where more readings are wrong, what else has changed cannot be told from what was misread."""


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
        labeller = fitter.labeller
        self._steadiness = Steadiness(labeller, settings.steady_tolerance)
        self._unnoticed = UnnoticedChanges(
            settings.attempts, everywhere=settings.unnoticed_everywhere
        )
        self._look_alikes = LookAlikes(settings.attempts)
        self._shelf = Shelf()
        self._ripeness = Ripeness(labeller)
        self._screen = Screen(labeller, self._steadiness, settings)
        self._rejections = Rejections(by_cause=settings.reject_by_cause)
        self._executions: dict[str, int] = {}
        self._attempts: Counter[Identity] = Counter()
        self._questions: Counter[Identity] = Counter()
        self._vain: Counter[int] = Counter()
        self._postponed: dict[Identity, tuple[Predicate, ...]] = {}
        self._open: frozenset[Identity] = frozenset()
        self._rounds_left = settings.max_inventions
        self._trials_left = settings.max_trials
        self._best: tuple[Predicate, ...] = ()

    def note_start(self, scene: Scene, start: Observation) -> None:
        """Take note of what a reset shows; what is not steady over starts is taken back."""
        if not self._settings.steady:
            return
        self._steadiness.note(scene, start)
        unsteady = self._steadiness.unsteady(self._vocabulary.active)
        self._rejections.ban(unsteady)
        self._drop(unsteady)
        for predicate in unsteady:
            self._listener(CandidateDecision(Verdict.RETRACTED, predicate, UNSTEADY))
            self._open = frozenset()

    def keep_up(self) -> Fit:
        """Invent during an episode, if a cause appears that was not there before."""
        fit = self._fitter.fit(self._vocabulary.active)
        if not self._settings.new_causes:
            return fit
        self._ripeness.look(fit.inconsistencies)
        causes = self._causes(fit)
        if causes - self._open:
            fit = self._mend()
            causes = self._causes(fit)
        self._open = causes
        self._ripeness.leave(fit.inconsistencies)
        return fit

    def invent(self) -> Fit:
        """Invent until nothing is inconsistent or every inconsistency was tried often enough.

        Ends an iteration: the next one may ask ``max_inventions`` questions again, and try
        ``max_trials`` candidates.
        """
        self._admit_new_data()
        if self._fitter.labeller.misread:
            self._ripeness.look(self._fitter.fit(self._vocabulary.active).inconsistencies)
        asks = self._settings.unnoticed and self._fitter.labeller.misread <= _SELDOM
        if asks:
            self._look_through_shelf()
            self._take_up_changes()
        fit = self._mend(ends=asks)
        if self._settings.keep_best:
            fit = self._keep_best(fit)
        self._open = self._causes(fit)
        self._ripeness.leave(fit.inconsistencies)
        self._rounds_left = self._settings.max_inventions
        self._trials_left = self._settings.max_trials
        return fit

    def _look_through_shelf(self) -> None:
        """Try candidates again that told nothing new when they were proposed (D26).

        They are read together: a question about a picture costs as much for one as for many.
        """
        active = {p.name for p in self._vocabulary.active}
        taken = self._shelf.take(len(self._fitter.recorded))
        due = [(p, asked) for p, asked in taken if p.name not in active]
        self._screen.look(due, self._vocabulary.active)
        left = [(p, a) for p, a in due if self._promising(a, [p], dormant=False)]
        self._fitter.labeller.announce([p for p, _ in left])
        for predicate, asked in left:
            if predicate.name not in {p.name for p in self._vocabulary.active}:
                fit = self._fitter.fit(self._vocabulary.active)
                self._try(asked, fit, [predicate], dormant=False)

    def _take_up_changes(self) -> None:
        """Take dormant names of changes into use that tell apart what nothing else does (D26)."""
        dormant = self._vocabulary.dormant_changes
        self._fitter.labeller.announce(dormant)
        for predicate in dormant:
            self._fitter.labeller.label([predicate])
            if not follows(self._fitter, self._vocabulary.active, predicate):
                self._vocabulary.accept(predicate, for_change=True)
                self._listener(CandidateDecision(Verdict.REVIVED, predicate, _TELLING))

    def _mend(self, *, ends: bool = False) -> Fit:
        """Resolve one inconsistency after the other; where an episode ends, unnoticed changes too.

        A predicate that splits the data into more operators than it explains transitions is
        taken back, once in a call, and what it explained is asked for again. Where something is
        left inconsistent, it may be one that resolved an inconsistency: a likeness of what is
        meant keeps that out.
        """
        self._throw_off()
        retracted: set[Predicate] = set()
        while True:
            fit = self._fitter.fit(self._vocabulary.active)
            may_ask = self._rounds_left and self._trials_left > 0
            inconsistency = self._next(fit, unnoticed=ends) if may_ask else None
            if inconsistency is not None:
                self._rounds_left -= 1
                self._resolve(inconsistency, fit)
                continue
            burdens = self._burdens(fit, retracted)
            if not burdens:
                return fit
            retracted.update(burdens)
            self._retract(burdens)

    def _burdens(self, fit: Fit, spared: set[Predicate]) -> tuple[Predicate, ...]:
        """What takes more than it explains; names of changes only where all is consistent."""
        changes = {p for p in self._vocabulary.active if p.name in self._vocabulary.changes}
        return self._find_burdens(fit, spared | changes if fit.witnesses else spared)

    def _throw_off(self) -> None:
        """Take back what leaves far more inconsistent than it explains, before more is asked.

        Also names of changes: what they bring up first is little (D26).
        """
        fit = self._fitter.fit(self._vocabulary.active)
        burdens = self._find_burdens(fit) if fit.witnesses else ()
        left = [p for p in self._vocabulary.active if p not in burdens]
        if self._fitter.fit(left).cost < min(_FAR_LESS * fit.cost, fit.cost - _MANY):
            self._retract(burdens)

    def _find_burdens(self, fit: Fit, spared: Collection[Predicate] = ()) -> tuple[Predicate, ...]:
        return find_burdens(
            self._fitter,
            self._vocabulary,
            spared,
            keeps_consistent=self._settings.spare_retraction and not fit.witnesses,
        )

    def _keep_best(self, fit: Fit) -> Fit:
        """Take the vocabulary of the last iteration up again if it leaves less inconsistent.

        Not if it lacks a name for a change: that often brings inconsistencies up first (D26).
        """
        active = self._vocabulary.active
        new = {p.name for p in active} - {p.name for p in self._best}
        differs = set(self._best) != set(active) and not new & self._vocabulary.changes
        if fit.witnesses and differs:
            earlier = self._fitter.fit(self._best)
            if _rank(earlier) < _rank(fit):
                self._vocabulary.use(self._best)
                fit = earlier
        self._best = self._vocabulary.active
        return fit

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
            self._vain.clear()
            self._postponed.clear()
            self._rejections.admit_data_of(new)

    def _next(self, fit: Fit, *, unnoticed: bool) -> Inconsistency | None:
        """The cause tried least; conditions 1 and 2 before determinism and unexplained changes.

        Only if nothing else is left, and ``unnoticed`` is asked for, a success that may have
        changed something unnoticed, and then two pictures that look alike.
        """
        tries = self._settings.attempts
        causes = distinct_causes(self._ripe(fit))
        left = [c for c in causes if self._attempts[c.identity] < tries and self._may_tell(c)]
        if not left and unnoticed:
            found = self._unnoticed.next(fit, self._fitter.recorded)
            if found is None and self._settings.look_alikes:
                found = self._look_alikes.next(self._fitter.labeller, self._vocabulary.active)
            return found
        return min(
            left,
            key=lambda c: (self._attempts[c.identity], _ORDER.index(c.kind)),
            default=None,
        )

    def _may_tell(self, cause: Inconsistency) -> bool:
        """Whether a success is shown of which it was not asked in vain too often what it changes.

        If readings may be wrong, further failures beside it tell no more; another success may.
        """
        if cause.kind is not InconsistencyKind.EFFECT or not self._fitter.labeller.misread:
            return True
        return any(self._vain[pair.first] < self._settings.attempts for pair in cause.pairs)

    def _ripe(self, fit: Fit) -> tuple[Inconsistency, ...]:
        """What is inconsistent and no suspected misreading."""
        return self._ripeness.ripe(fit.inconsistencies, self._vocabulary.active)

    def _causes(self, fit: Fit) -> frozenset[Identity]:
        return frozenset(one.identity for one in self._ripe(fit))

    def _drop(self, predicates: Sequence[Predicate]) -> None:
        """Forget predicates, also as a part of what was best."""
        self._vocabulary.drop(predicates)
        self._best = tuple(p for p in self._best if p not in predicates)

    def _retract(self, predicates: Sequence[Predicate]) -> None:
        self._drop(predicates)
        self._rejections.retract(predicates)
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
        if attempt == 0 and self._settings.widen and self._try_wider(inconsistency, fit):
            return
        if attempt == 0 and self._settings.exchange and self._try_exchange(inconsistency):
            return
        number = self._questions[inconsistency.identity]
        self._questions[inconsistency.identity] += 1
        pairs = inconsistency.pairs if self._settings.rotate else (inconsistency,)
        rejected = self._rejections.of(inconsistency.identity)
        shown = pairs[number % len(pairs)]
        proposed = self._proposer.propose(shown, fit.predicates, rejected, number)
        fresh = self._vocabulary.fresh(proposed, rejected)
        is_named = self._try(inconsistency, fit, fresh, dormant=False)
        if inconsistency.since is not None:
            recorded = self._fitter.recorded
            self._look_alikes.note(inconsistency, recorded, in_vain=not is_named)
        elif _is_of_a_change(inconsistency):
            self._unnoticed.note(
                inconsistency,
                len(self._fitter.recorded),
                nothing=not proposed,
                in_vain=not is_named,
                silent=fit.skill(inconsistency.skill).unnoticed is not None,
            )
        if is_named:
            return
        if inconsistency.kind is InconsistencyKind.EFFECT:
            self._vain.update({pair.first for pair in inconsistency.pairs})
        postponed = self._postponed.get(inconsistency.identity, ())
        if attempt + 1 >= self._settings.attempts and postponed:
            self._take_best(inconsistency, postponed)

    def _try_wider(self, inconsistency: Inconsistency, fit: Fit) -> bool:
        """Whether it helps to say of wider types, that the skill takes, what is said already."""
        skill = self._fitter.recorded.domain.skill_by_name[inconsistency.skill]
        wider = self._vocabulary.wider([p.type for p in skill.parameters])
        rejected = self._rejections.of(inconsistency.identity)
        fresh = [p for p in wider if p not in rejected]
        return bool(fresh) and self._try(inconsistency, fit, fresh, dormant=False)

    def _try_exchange(self, inconsistency: Inconsistency) -> bool:
        """Whether it helps to take a dormant predicate in place of an active one."""
        if _is_of_a_change(inconsistency):
            return False
        exchange = find_exchange(self._fitter, self._vocabulary, inconsistency)
        if exchange is None:
            return False
        old, new = exchange.dormant, exchange.active
        self._vocabulary.set_dormant(old)
        self._vocabulary.accept(new)
        self._postponed.clear()
        reason = f"less is inconsistent with {new.name} in its place"
        self._listener(CandidateDecision(Verdict.RETRACTED, old, reason, inconsistency))
        reason = f"resolves the inconsistency in place of {old.name}"
        self._listener(CandidateDecision(Verdict.REVIVED, new, reason, inconsistency))
        return True

    def _try(
        self,
        inconsistency: Inconsistency,
        fit: Fit,
        candidates: Sequence[Predicate],
        *,
        dormant: bool,
    ) -> bool:
        """Keep the best of the candidates that resolve the inconsistency, if it is worth it."""
        promising = self._promising(inconsistency, candidates, dormant=dormant)
        self._trials_left -= len(promising)
        self._fitter.labeller.label(promising)  # all pictures for all candidates in one go
        trials = [self._trial(inconsistency, p, dormant=dormant) for p in promising]
        good = [t for t in trials if not t.shortcoming(self._settings.threshold)]
        worth = [t for t in good if t.is_worth_it(fit, inconsistency.kind)]
        best = min(worth, key=Trial.rank, default=None)
        others = [t for t in worth if t is not best and _is_of_a_change(inconsistency)]
        for trial in trials:
            if trial not in others:
                self._record(inconsistency, trial, best, worth)
        if best is not None:
            self._accept(best, inconsistency)
            if others:  # more than one thing may have changed
                fit = self._fitter.fit(self._vocabulary.active)
                self._try(inconsistency, fit, [t.predicate for t in others], dormant=dormant)
        else:
            known = self._postponed.get(inconsistency.identity, ())
            self._postponed[inconsistency.identity] = (*known, *(t.predicate for t in good))
        return best is not None

    def _take_best(self, inconsistency: Inconsistency, postponed: Sequence[Predicate]) -> None:
        fit, kind = self._fitter.fit(self._vocabulary.active), inconsistency.kind
        asleep = self._vocabulary.dormant
        trials = [self._trial(inconsistency, p, dormant=p in asleep) for p in postponed]
        resolving = [t for t in trials if not t.remains and not t.undecided]
        slack = self._settings.operator_cost
        worth = [t for t in resolving if t.is_worth_it(fit, kind, slack)]
        best = min(worth, key=Trial.rank, default=None)
        if best is not None:
            reason = "the best that came for an inconsistency"
            self._decide(_acceptance(best), inconsistency, best, reason)
            self._accept(best, inconsistency)

    def _accept(self, trial: Trial, inconsistency: Inconsistency) -> None:
        for_change = _is_of_a_change(inconsistency)
        self._vocabulary.accept(trial.predicate, for_change=for_change)
        self._postponed.clear()

    def _promising(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate], *, dormant: bool
    ) -> list[Predicate]:
        """The candidates of which nothing speaks against labelling them everywhere."""
        promising = []
        vocabulary = self._vocabulary.active
        for predicate, flaw in self._screen.flaws(inconsistency, candidates, vocabulary):
            if not flaw:
                promising.append(predicate)
            elif flaw == NOTHING_NEW:
                self._shelf.put(predicate, inconsistency, len(self._fitter.recorded))
            elif not dormant:
                self._reject(predicate, inconsistency, flaw)
                self._listener(CandidateDecision(Verdict.REJECTED, predicate, flaw, inconsistency))
        return promising

    def _reject(self, predicate: Predicate, inconsistency: Inconsistency, flaw: str = "") -> None:
        if flaw == UNSTEADY:
            self._rejections.ban([predicate])
        else:
            self._rejections.reject(predicate, inconsistency.identity)

    def _trial(self, inconsistency: Inconsistency, predicate: Predicate, *, dormant: bool) -> Trial:
        before = self._fitter.fit(self._vocabulary.active)
        fit = self._fitter.fit(self._vocabulary.with_candidate(predicate))
        trial = Trial.of(predicate, inconsistency, dormant=dormant, before=before, fit=fit)
        return replace(trial, misreadings=self._fitter.labeller.misreadings(predicate))

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
            self._reject(trial.predicate, inconsistency)
        self._decide(Verdict.REJECTED, inconsistency, trial, reason)

    def _decide(
        self, verdict: Verdict, inconsistency: Inconsistency, trial: Trial, reason: str
    ) -> None:
        self._listener(
            CandidateDecision(verdict, trial.predicate, reason, inconsistency, trial.score)
        )


def _is_of_a_change(inconsistency: Inconsistency) -> bool:
    """Whether it was asked what has changed, perhaps without being noticed (D26)."""
    return inconsistency.kind is InconsistencyKind.UNNOTICED


def _acceptance(trial: Trial) -> Verdict:
    return Verdict.REVIVED if trial.dormant else Verdict.ACCEPTED


def _rank(fit: Fit) -> tuple[int, float]:
    """Smaller is better: inconsistencies and unnoticed changes, then what the operators cost."""
    return len(fit.witnesses) + len(fit.unnoticed), fit.cost

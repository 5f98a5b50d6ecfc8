"""Version spaces: which of an operator's conditions are needed, as far as the data tell.

The learned precondition is the most specific one: all that held before every transition of the
cluster. The true one is a part of it. Every part is a hypothesis; a transition outside the cluster,
where the operator must not apply, speaks against those that would have let it. What is left,
weighed by how likely conditions of their kind are needed, says what a try would tell.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE, AtomSpace
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import attempts_of
from skillwrapper.learning.unmet_conditions import MOST_UNMET, UnmetConditions
from skillwrapper.learning.untested import narrowed_types
from skillwrapper.symbols import Absence, Literal, Operator, Variable
from skillwrapper.symbols.describe import describe_condition
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.domain import Domain

_ENUMERATED = 12
"""All parts of so many conditions are hypotheses; of more, some are drawn."""
_DRAWN = 4096
_REPETITIONS = 3
"""Equal counterexamples count so often at most."""


@dataclass(frozen=True)
class Prior:
    """How likely a condition is needed, before anything was tried.

    Attributes:
        positive: a literal that must hold.
        negative: a literal that must not.
        absence: that no object stands in a relation.
        types: that an object is of narrower types than the skill asks for.
        sibling: what a condition passes on, of its probability, to the same condition of another
            operator of the skill.
        missing: what is left for every other operator of the skill that lacks the condition.
    """

    positive: float = 0.5
    negative: float = 0.25
    absence: float = 0.35
    types: float = 0.15
    sibling: float = 0.95
    missing: float = 0.6

    def of(self, condition: Condition) -> float:
        """The probability by the kind of a condition."""
        match condition:
            case Literal():
                return self.positive if condition.positive else self.negative
            case Absence():
                return self.absence
            case Variable():
                return self.types


@dataclass(frozen=True, eq=False)
class VersionSpace:
    """What the precondition of an operator may be.

    Attributes:
        operator: the operator; its precondition is the most specific one.
        conditions: its conditions, in a fixed order.
        narrowed: the parameters whose types are among them.
        needed: every hypothesis as the conditions that it needs (hypotheses, conditions).
        consistent: which hypotheses (hypotheses,) no counterexample speaks against.
        weights: the probability (hypotheses,) of each.
    """

    operator: Operator
    conditions: tuple[Condition, ...]
    narrowed: frozenset[Variable]
    needed: NDArray[np.bool_]
    consistent: NDArray[np.bool_]
    weights: NDArray[np.float64]

    @cached_property
    def probability(self) -> dict[Condition, float]:
        """How likely each condition is needed."""
        return dict(zip(self.conditions, (self.weights @ self.needed).tolist(), strict=True))

    @cached_property
    def proven(self) -> frozenset[Condition]:
        """The conditions without which some counterexample cannot be explained."""
        rows = self.needed[self.consistent] if self.consistent.any() else self.needed
        return frozenset(self.conditions[n] for n in np.flatnonzero(rows.all(axis=0)))

    @property
    def open(self) -> frozenset[Condition]:
        """The conditions that may or may not be needed."""
        return frozenset(self.conditions) - self.proven

    @cached_property
    def most_general(self) -> tuple[frozenset[Condition], ...]:
        """The smallest preconditions that explain all counterexamples; none if nothing does."""
        rows = self.needed[self.consistent]
        rows = rows[np.argsort(rows.sum(axis=1), kind="stable")]
        found: list[NDArray[np.bool_]] = []
        while len(rows):
            smallest, rows = rows[0], rows[1:]
            found.append(smallest)
            rows = rows[(smallest & ~rows).any(axis=1)]
        return tuple(
            frozenset(self.conditions[n] for n in np.flatnonzero(smallest)) for smallest in found
        )

    def success_probability(self, space: AtomSpace, attempts: Attempts) -> NDArray[np.float64]:
        """How likely the operator applies to attempts, in some binding (attempts,).

        Args:
            space: the ground atoms of the attempts' states.
            attempts: skill instances in abstract states; unknown labels count against them.
        """
        indexed = IndexedOperator(self.operator, space, self.narrowed)
        unmet = UnmetConditions.of(indexed, attempts)
        probability = np.append(unmet.excused(self.needed) @ self.weights, 0.0)
        found: NDArray[np.float64] = probability[unmet.family]
        return found

    def doubts(self, space: AtomSpace, attempts: Attempts) -> tuple[float, list[str]]:
        """How likely the operator applies to one attempt, and what it hangs on, in words.

        That is, the conditions that are not met in the likeliest binding.
        """
        best: tuple[float, list[str]] = (0.0, [])
        indexed = IndexedOperator(self.operator, space, self.narrowed)
        for bindings in find_bindings(indexed, attempts, most_unmet=MOST_UNMET):
            for unmet, objects in zip(bindings.met() != TRUE, bindings.objects, strict=True):
                likely = float(self.weights[~(self.needed & unmet).any(axis=1)].sum())
                if likely > best[0]:
                    names = [space.objects[number].name for number in objects]
                    named = dict(
                        zip((v.name for v in self.operator.parameters), names, strict=True)
                    )
                    lacking = [c for c, x in zip(self.conditions, unmet, strict=True) if x]
                    best = likely, [describe_condition(c, named) for c in lacking]
        return best


def version_spaces(
    fit: Fit, skill: str, *, prior: Prior | None = None, doubt: float = 0.0
) -> tuple[VersionSpace, ...]:
    """The version spaces of the operators of a skill; what is likely in one is so in others.

    Args:
        fit: what was learned.
        skill: name of the skill.
        prior: how likely conditions are needed beforehand.
        doubt: how likely a counterexample comes of a wrong label or of a cause that no predicate
            speaks of yet, 0 to 1; 0 takes every one for right.
    """
    prior, of_skill = prior or Prior(), fit.skill(skill)
    evidence = [_Evidence.of(fit, learned, of_skill) for learned in of_skill.operators]
    own_priors = [[prior.of(c) for c in e.conditions] for e in evidence]
    if len(evidence) < 2:
        return tuple(e.weigh(own, doubt) for e, own in zip(evidence, own_priors, strict=True))
    # What only tells one operator from another says nothing of whether the skill works.
    failing = [
        e.weigh(own, doubt, failures_only=True) for e, own in zip(evidence, own_priors, strict=True)
    ]
    return tuple(
        own.weigh(_pooled(prior, failing, number), doubt) for number, own in enumerate(evidence)
    )


@dataclass(frozen=True, eq=False)
class _Evidence:
    """Counterexamples of an operator: transitions where it must not apply.

    Attributes:
        operator: the operator.
        conditions: its conditions.
        narrowed: the parameters whose types are among them.
        scenes: of each scene what is unmet in them.
        failures: the same of those of them that failed.
    """

    operator: Operator
    conditions: tuple[Condition, ...]
    narrowed: frozenset[Variable]
    scenes: tuple[UnmetConditions, ...]
    failures: tuple[UnmetConditions, ...]

    @classmethod
    def of(cls, fit: Fit, learned: LearnedOperator, of_skill: SkillFit) -> _Evidence:
        signatures = {p.name: p.types for p in fit.predicates}
        narrowed = frozenset(_doubtful_types(fit.domain, signatures, learned.operator))
        scenes: list[UnmetConditions] = []
        failures: list[UnmetConditions] = []
        conditions: tuple[Condition, ...] = ()
        for prediction in of_skill.predictions:
            table = prediction.table
            indexed = IndexedOperator(learned.operator, table.space, narrowed)
            others = ~np.isin(table.ids, learned.cluster.ids)
            for found, rows in ((scenes, others), (failures, others & ~table.success)):
                attempts = attempts_of(table, np.flatnonzero(rows))
                found.append(UnmetConditions.of(indexed, attempts))
            conditions = indexed.conditions
        return cls(learned.operator, conditions, narrowed, tuple(scenes), tuple(failures))

    def weigh(
        self, prior: Sequence[float], doubt: float, *, failures_only: bool = False
    ) -> VersionSpace:
        """Weigh all hypotheses by a prior of every condition and by the counterexamples."""
        chances = np.array(prior, dtype=np.float64)
        counterexamples = self.failures if failures_only else self.scenes
        needed, weights = self._hypotheses(chances, counterexamples)
        against = np.zeros(len(needed), dtype=np.intp)
        for unmet in counterexamples:
            times = np.bincount(unmet.family[unmet.family >= 0], minlength=len(unmet.families))
            against += np.minimum(times, _REPETITIONS) @ unmet.excused(needed)
        weights = weights * float(doubt) ** (against - against.min())
        return VersionSpace(
            self.operator,
            self.conditions,
            self.narrowed,
            needed,
            against == 0,
            weights / weights.sum(),
        )

    def _hypotheses(
        self, chances: NDArray[np.float64], counterexamples: Sequence[UnmetConditions]
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Parts of the conditions (hypotheses, conditions), with their weights beforehand."""
        size = len(self.conditions)
        if size <= _ENUMERATED:
            needed = (np.arange(1 << size)[:, np.newaxis] >> np.arange(size)) & 1 == 1
            return needed, np.where(needed, chances, 1 - chances).prod(axis=1)
        drawn = np.random.default_rng(0).random((_DRAWN, size)) < chances
        needed = np.vstack([drawn, np.ones((1, size), dtype=bool), ~np.eye(size, dtype=bool)])
        return needed | self._surely_needed(counterexamples), np.where(
            np.arange(len(needed)) < _DRAWN, 1.0, 0.2
        )

    def _surely_needed(self, counterexamples: Sequence[UnmetConditions]) -> NDArray[np.bool_]:
        """Conditions (conditions,) that a counterexample leaves as the only explanation."""
        found = np.zeros(len(self.conditions), dtype=bool)
        for unmet in counterexamples:
            single = unmet.families[(unmet.families[:, 1:] < 0).all(axis=1), 0]
            sets = unmet.sets[single]
            found |= sets[sets.sum(axis=1) == 1].any(axis=0)
        return found


def _doubtful_types(
    domain: Domain, signatures: Mapping[str, tuple[str, ...]], operator: Operator
) -> Iterator[Variable]:
    """The parameters that may stand for objects of other types as well.

    Also those of the skill's own whose types a literal implies, as it may not be needed either.
    """
    yield from narrowed_types(domain, signatures, operator)
    skill = domain.skill_by_name[operator.skill]
    for variable, parameter in zip(operator.parameters, skill.parameters, strict=False):
        if not domain.types.closure([parameter.type]).issuperset(variable.types):
            yield variable


def _pooled(prior: Prior, alone: Sequence[VersionSpace], number: int) -> list[float]:
    """The prior of an operator's conditions, after what the skill's other operators tell."""
    others = [space.probability for place, space in enumerate(alone) if place != number]
    pooled = []
    for condition in alone[number].conditions:
        shared = [prior.sibling * other[condition] for other in others if condition in other]
        lacking = prior.missing ** (len(others) - len(shared))
        own = prior.of(condition)
        pooled.append(max(shared) if shared and max(shared) > own else own * lacking)
    return pooled

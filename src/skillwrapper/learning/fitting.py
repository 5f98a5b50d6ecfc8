"""A fit: operators of a vocabulary and what they leave inconsistent, skill by skill."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.inconsistencies import (
    Inconsistency,
    Misprediction,
    Witness,
    count_valid_effects,
    count_valid_executability,
    describe_mispredictions,
    find_mispredictions,
    find_unnoticed,
)
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.symbols import AbstractModel, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


@dataclass(frozen=True)
class SkillFit:
    """What was learned of one skill.

    Attributes:
        skill: its name.
        operators: its operators, one a cluster (or a part of a cluster, D5).
        predictions: what they say of the skill's own transitions.
        left_out: the clusters of which no operator was learned; none of them is accounted for.
        price: how many transitions an operator has to account for to be worth having.
        frail: numbers of successes that are worth seeing again, as wrong labels of a single one
            would lead to other operators; empty where labels are right (D24).
    """

    skill: str
    operators: tuple[LearnedOperator, ...]
    predictions: tuple[TablePrediction, ...]
    left_out: tuple[Cluster, ...] = ()
    price: float = 0.0
    frail: tuple[int, ...] = ()

    @cached_property
    def witnesses(self) -> frozenset[Witness]:
        """All inconsistencies, in a form that can be compared across vocabularies."""
        return frozenset((m.kind, self.skill, m.culprit) for m in self._mispredictions)

    @cached_property
    def inconsistencies(self) -> tuple[Inconsistency, ...]:
        """All, in order of kind and time."""
        return describe_mispredictions(self.skill, self.predictions, self._mispredictions)

    @cached_property
    def unnoticed(self) -> Inconsistency | None:
        """That no success changes anything in the vocabulary, although it may in truth (D26)."""
        return find_unnoticed(self.skill, self.predictions)

    @cached_property
    def _mispredictions(self) -> tuple[Misprediction, ...]:
        return find_mispredictions(self.predictions)

    @property
    def cost(self) -> float:
        """Its share of the cost of a fit."""
        return self.operator_cost + len(self.witnesses)

    @property
    def operator_cost(self) -> float:
        """What its operators cost; one that was left out is as dear as one that was learned."""
        return self.price * (len(self.operators) + len(self.left_out))

    @cached_property
    def undecided(self) -> frozenset[int]:
        """Numbers of the transitions that hang on an unknown label (D10)."""
        return frozenset(int(i) for p in self.predictions for i in p.table.ids[p.undecided])

    def score(self, kind: InconsistencyKind) -> float | None:
        """Share of valid transitions (Algorithm 5 of the paper, with D6).

        Executability counts for PRECONDITION and DETERMINISM, changes for the other kinds;
        None, undefined, if no transition is decided (D25).
        """
        if kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.DETERMINISM):
            valid, decided = count_valid_executability(self.predictions)
        else:
            valid, decided = count_valid_effects(self.predictions)
        return valid / decided if decided else None


class Fit:
    """What was learned with one vocabulary; each skill is learned when somebody looks at it.

    Args:
        domain: types and skills.
        predicates: the vocabulary, tautologies included.
        learn_skill: learns one skill.
    """

    def __init__(
        self,
        domain: Domain,
        predicates: Sequence[Predicate],
        learn_skill: Callable[[Skill], SkillFit],
    ) -> None:
        self.domain = domain
        self.predicates = tuple(predicates)
        self._learn_skill = learn_skill
        self._known: dict[str, SkillFit] = {}

    def skill(self, name: str) -> SkillFit:
        """What was learned of one skill."""
        if name not in self._known:
            self._known[name] = self._learn_skill(self.domain.skill_by_name[name])
        return self._known[name]

    def each(self) -> Iterator[SkillFit]:
        """One skill after the other, for who may have seen enough before the last."""
        return (self.skill(skill.name) for skill in self.domain.skills)

    @cached_property
    def skills(self) -> dict[str, SkillFit]:
        """What was learned of every skill."""
        return {fit.skill: fit for fit in self.each()}

    @cached_property
    def inconsistencies(self) -> tuple[Inconsistency, ...]:
        """All inconsistencies of all skills."""
        return tuple(i for fit in self.each() for i in fit.inconsistencies)

    @cached_property
    def unnoticed(self) -> tuple[Inconsistency, ...]:
        """The skills of which no success changes anything, which may be as it should be (D26)."""
        return tuple(fit.unnoticed for fit in self.each() if fit.unnoticed is not None)

    @cached_property
    def witnesses(self) -> frozenset[Witness]:
        """All inconsistencies, in a form that can be compared across vocabularies."""
        return frozenset().union(*(fit.witnesses for fit in self.each()))

    @cached_property
    def operators(self) -> tuple[LearnedOperator, ...]:
        """All operators of all skills."""
        return tuple(o for fit in self.each() for o in fit.operators)

    @property
    def cost(self) -> float:
        """What it takes to account for the data: operators, and transitions that are wrong.

        An operator counts as much as ``learning.operator_cost`` transitions: one that is not
        needed for more is no insight.
        """
        return sum(fit.cost for fit in self.each())

    @property
    def hard_cost(self) -> float:
        """The same without the transitions that are wrong by the third and fourth kind."""
        hard = (InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT)
        wrong = sum(kind in hard for kind, _, _ in self.witnesses)
        return sum(fit.operator_cost for fit in self.each()) + wrong

    @property
    def model(self) -> AbstractModel:
        """The learned abstract model."""
        return AbstractModel(
            self.domain, self.predicates, tuple(o.operator for o in self.operators)
        )

"""Fitting: operators and inconsistencies of a vocabulary, skill by skill, nothing done twice."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.grounding import FALSE, TRUE
from skillwrapper.learning.determinism import make_deterministic
from skillwrapper.learning.inconsistencies import (
    Inconsistency,
    Misprediction,
    Witness,
    count_valid_effects,
    count_valid_executability,
    describe_mispredictions,
    find_mispredictions,
)
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.symbols import AbstractModel, Predicate
from skillwrapper.transitions.dataset import Dataset, Reading, TruthSource
from skillwrapper.transitions.tables import SkillData
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill

OPERATOR_COST = 2
"""Transitions that an operator has to account for to be worth having."""


@dataclass(frozen=True)
class SkillFit:
    """What was learned of one skill.

    Attributes:
        skill: its name.
        operators: its operators, one a cluster (or a part of a cluster, D5).
        predictions: what they say of the skill's own transitions.
    """

    skill: str
    operators: tuple[LearnedOperator, ...]
    predictions: tuple[TablePrediction, ...]

    @cached_property
    def witnesses(self) -> frozenset[Witness]:
        """All inconsistencies, in a form that can be compared across vocabularies."""
        return frozenset((m.kind, self.skill, m.culprit) for m in self._mispredictions)

    @cached_property
    def inconsistencies(self) -> tuple[Inconsistency, ...]:
        """All, in order of kind and time."""
        return describe_mispredictions(self.skill, self.predictions, self._mispredictions)

    @cached_property
    def _mispredictions(self) -> tuple[Misprediction, ...]:
        return find_mispredictions(self.predictions)

    @property
    def cost(self) -> int:
        """Its share of the cost of a fit."""
        return OPERATOR_COST * len(self.operators) + len(self.witnesses)

    @cached_property
    def undecided(self) -> frozenset[int]:
        """Numbers of the transitions that hang on an unknown label (D10)."""
        return frozenset(int(i) for p in self.predictions for i in p.table.ids[p.undecided])

    def score(self, kind: InconsistencyKind) -> float:
        """Share of valid transitions (Algorithm 5 of the paper, with D6).

        Executability counts for PRECONDITION and DETERMINISM, changes for the other kinds;
        1.0 if no transition is decided.
        """
        if kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.DETERMINISM):
            valid, decided = count_valid_executability(self.predictions)
        else:
            valid, decided = count_valid_effects(self.predictions)
        return valid / decided if decided else 1.0


@dataclass(frozen=True)
class Fit:
    """What was learned with one vocabulary.

    Attributes:
        domain: the domain.
        predicates: the vocabulary, tautologies included.
        skills: what was learned of each skill.
    """

    domain: Domain
    predicates: tuple[Predicate, ...]
    skills: dict[str, SkillFit]

    @cached_property
    def inconsistencies(self) -> tuple[Inconsistency, ...]:
        """All inconsistencies of all skills."""
        return tuple(i for fit in self.skills.values() for i in fit.inconsistencies)

    @cached_property
    def witnesses(self) -> frozenset[Witness]:
        """All inconsistencies, in a form that can be compared across vocabularies."""
        return frozenset().union(*(fit.witnesses for fit in self.skills.values()))

    @cached_property
    def operators(self) -> tuple[LearnedOperator, ...]:
        """All operators of all skills."""
        return tuple(o for fit in self.skills.values() for o in fit.operators)

    @property
    def cost(self) -> int:
        """What it takes to account for the data: operators, and transitions that are wrong.

        An operator counts as much as ``OPERATOR_COST`` transitions: one that is not needed for
        more is no insight.
        """
        return sum(fit.cost for fit in self.skills.values())

    @property
    def hard_cost(self) -> int:
        """The same without the transitions that are wrong by the third and fourth kind."""
        hard = (InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT)
        wrong = sum(kind in hard for kind, _, _ in self.witnesses)
        return OPERATOR_COST * len(self.operators) + wrong

    @property
    def model(self) -> AbstractModel:
        """The learned abstract model."""
        return AbstractModel(
            self.domain, self.predicates, tuple(o.operator for o in self.operators)
        )


class Fitter:
    """Learns operators for vocabularies; remembers what it learned of unchanged skills.

    Adding an episode relearns only the skills that occur in it, unless it turned a tautology
    into a predicate that says something.

    Args:
        domain: types, objects and skills.
        dataset: the transitions; may grow.
        truth: the labels of their pictures.
        absences: whether preconditions may be universal absences (D2).
    """

    def __init__(
        self, domain: Domain, dataset: Dataset, truth: TruthSource, *, absences: bool = True
    ) -> None:
        self.domain = domain
        self.dataset = dataset
        self.truth = truth
        self.reading = Reading(dataset, truth)
        self._absences = absences
        self._fits: dict[tuple[str, int, tuple[Predicate, ...]], SkillFit] = {}
        self._tautology: dict[tuple[Predicate, int], bool] = {}

    def fit(self, predicates: Sequence[Predicate]) -> Fit:
        """Learn all skills with a vocabulary."""
        skills = {fit.skill: fit for fit in self.fit_each(predicates)}
        return Fit(self.domain, tuple(predicates), skills)

    def fit_each(self, predicates: Sequence[Predicate]) -> Iterator[SkillFit]:
        """The same, one skill after the other, for who may have seen enough before the last."""
        useful = self._useful(predicates)
        return (self._fit_skill(skill, useful) for skill in self.domain.skills)

    def fit_skill(self, skill: str, predicates: Sequence[Predicate]) -> SkillFit:
        """Learn one skill with a vocabulary."""
        useful = self._useful(predicates)
        return self._fit_skill(self.domain.skill_by_name[skill], useful)

    def _useful(self, predicates: Sequence[Predicate]) -> tuple[Predicate, ...]:
        """Those that are no tautologies; what is not labelled yet is asked for in one go."""
        fresh = [p for p in predicates if (p, len(self.dataset)) not in self._tautology]
        for scene in self.dataset.scenes if fresh else ():
            self.reading.labels(scene, fresh)
        return tuple(p for p in predicates if not self.is_tautology(p))

    def is_tautology(self, predicate: Predicate) -> bool:
        """Whether all known labels of a predicate are equal, over all data (D9)."""
        key = (predicate, len(self.dataset))
        if key not in self._tautology:
            seen: set[int] = set()
            for scene in self.dataset.scenes:
                labels = self.reading.labels(scene, [predicate])
                seen |= {value for value in (TRUE, FALSE) if (labels == value).any()}
            self._tautology[key] = len(seen) < 2
        return self._tautology[key]

    def forget(self) -> None:
        """Drop remembered fits of earlier data; called when an iteration ends."""
        size = {s.name: len(self.dataset.numbers_of(s.name)) for s in self.domain.skills}
        self._fits = {k: v for k, v in self._fits.items() if size[k[0]] == k[1]}
        self._tautology = {k: v for k, v in self._tautology.items() if k[1] == len(self.dataset)}
        self.reading.forget_spaces()

    def _fit_skill(self, skill: Skill, predicates: tuple[Predicate, ...]) -> SkillFit:
        key = (skill.name, len(self.dataset.numbers_of(skill.name)), predicates)
        if key not in self._fits:
            self._fits[key] = fit_skill(
                self.domain,
                skill,
                self.reading.skill_data(skill.name, predicates),
                predicates,
                absences=self._absences,
            )
        return self._fits[key]


def fit_skill(
    domain: Domain,
    skill: Skill,
    data: SkillData,
    predicates: Sequence[Predicate],
    *,
    absences: bool = True,
) -> SkillFit:
    """Learn one skill from its transitions."""
    operators, predictions = make_deterministic(domain, skill, data, predicates, absences=absences)
    return SkillFit(skill.name, operators, predictions)

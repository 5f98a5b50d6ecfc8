"""The questions that the rest of the package asks a model, and their answers, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols.predicates import Atom, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import Skill, SkillInstance
from skillwrapper.world.types import Object


@dataclass(frozen=True)
class ProposalQuestion:
    """Which skill sequences to try next (paper, Section 3.1; DESIGN.md D16).

    Attributes:
        domain: types, objects and skills.
        objects: the objects of the scene.
        observation: what is seen at the start of the sequence.
        predicates: the present vocabulary.
        operators: the present operators, one readable line each.
        least_explored: pairs of skill instances that were tried least.
        scarce_skills: names of skills with fewer than three successes.
        count: how many sequences are wanted.
        length: how many skills each sequence should have at least.
    """

    domain: Domain
    objects: tuple[Object, ...]
    observation: Observation
    predicates: tuple[Predicate, ...]
    operators: tuple[str, ...]
    least_explored: tuple[tuple[SkillInstance, SkillInstance], ...]
    scarce_skills: tuple[str, ...]
    count: int
    length: int


@dataclass(frozen=True)
class ProposalAnswer:
    """Parsed sequences, and what could not be used, line by line with the reason."""

    sequences: tuple[tuple[SkillInstance, ...], ...]
    unusable: tuple[str, ...] = ()


@dataclass(frozen=True)
class InventionQuestion:
    """Which predicate is missing (paper, Section 3.2; DESIGN.md D1, D5, D8).

    Attributes:
        domain: types, objects and skills.
        skill: the skill whose transitions are inconsistent.
        kind: the kind of inconsistency.
        first: a witness; for PRECONDITION and EFFECT the successful one, for DETERMINISM the
            one whose change was mispredicted, for UNEXPLAINED the one with the unexplained change.
        second: the other witness; None for UNEXPLAINED.
        types: the types that parameters of the new predicate may have.
        unexplained: for UNEXPLAINED, the changed atoms connected to nothing.
        current: the present vocabulary.
        rejected: candidates that were tried and rejected.
        count: how many candidates are wanted.
        attempt: 0 for the first time the question is asked, then 1, 2, ...
    """

    domain: Domain
    skill: Skill
    kind: InconsistencyKind
    first: Transition
    second: Transition | None
    types: tuple[str, ...]
    unexplained: tuple[Atom, ...]
    current: tuple[Predicate, ...]
    rejected: tuple[Predicate, ...]
    count: int
    attempt: int = 0


@dataclass(frozen=True)
class InventionAnswer:
    """Parsed candidates, and what could not be used, with the reason."""

    predicates: tuple[Predicate, ...]
    unusable: tuple[str, ...] = ()


@dataclass(frozen=True)
class BatchInventionQuestion:
    """All predicates at once from many pictures (the FM Invent baseline)."""

    domain: Domain
    observations: tuple[Observation, ...]
    count: int


@dataclass(frozen=True)
class EvaluationQuestion:
    """Which ground atoms are true in a picture (paper, Appendix, two-stage evaluation).

    Attributes:
        domain: types, objects and skills.
        objects: the objects of the scene.
        observation: the picture.
        predicates: the predicates to ask for, all groundings each.
    """

    domain: Domain
    objects: tuple[Object, ...]
    observation: Observation
    predicates: tuple[Predicate, ...]


@dataclass(frozen=True)
class EvaluationAnswer:
    """Labels: True, False, or None for unknown; every grounding asked for has an entry.

    Attributes:
        labels: the label of every grounding.
        agreement: if there were several votes, the share of them that the label has, 0 to 1.
    """

    labels: Mapping[Atom, bool | None]
    agreement: Mapping[Atom, float] = field(default_factory=dict)


@dataclass(frozen=True)
class ActionQuestion:
    """The next action towards a goal picture (the ViLa baseline)."""

    domain: Domain
    objects: tuple[Object, ...]
    observation: Observation
    goal: Observation
    history: tuple[tuple[SkillInstance, bool], ...]


@dataclass(frozen=True)
class ActionAnswer:
    """The plan from here on; ``done`` and ``impossible`` as the model says.

    Attributes:
        plan: what to do next, in order.
        done: the model says that the goal is reached already; the plan is then empty.
        impossible: the model says that the goal cannot be reached; the plan is then empty.
    """

    plan: tuple[SkillInstance, ...]
    done: bool = False
    impossible: bool = False

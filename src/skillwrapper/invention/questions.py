"""What invention asks a model: which predicate is missing."""

from __future__ import annotations

from dataclasses import dataclass

from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols.predicates import Atom, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import Skill


@dataclass(frozen=True)
class InventionQuestion:
    """Which predicate is missing (paper, Section 3.2; D1, D5, D8).

    Attributes:
        domain: types, objects and skills.
        skill: the skill whose transitions are inconsistent.
        kind: the kind of inconsistency.
        first: a witness; for PRECONDITION and EFFECT the successful one, for DETERMINISM the
            one whose change was mispredicted, for UNEXPLAINED the one with the unexplained change,
            for UNNOTICED a success that seems to change nothing.
        second: the other witness; None for UNEXPLAINED and UNNOTICED.
        types: the types that parameters of the new predicate may have.
        unexplained: for UNEXPLAINED, the changed atoms connected to nothing.
        current: the present vocabulary.
        rejected: candidates that were tried and rejected.
        count: how many candidates are wanted.
        wide: for UNNOTICED whether the change may be one of other objects than the arguments.
        long: for UNNOTICED whether the first picture was taken long before, with other skills in
            between, and in ``first`` stands in the place of the one before.
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
    wide: bool = False
    long: bool = False


@dataclass(frozen=True)
class InventionAnswer:
    """Parsed candidates, and what could not be used, with the reason."""

    predicates: tuple[Predicate, ...]
    unusable: tuple[str, ...] = ()


@dataclass(frozen=True)
class RephrasingQuestion:
    """How a candidate is said that leaves open which object it is about (D8).

    Attributes:
        domain: types, objects and skills.
        candidate: speaks of a certain object, or of some object of a type.
        types: the types of the parameters that are wanted, in their order.
    """

    domain: Domain
    candidate: Predicate
    types: tuple[str, ...]


@dataclass(frozen=True)
class BatchInventionQuestion:
    """All predicates at once from many pictures (the FM Invent baseline)."""

    domain: Domain
    observations: tuple[Observation, ...]
    count: int

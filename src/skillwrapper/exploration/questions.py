"""What exploration asks a model: which skill sequences to try next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from skillwrapper.symbols.predicates import Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object


@dataclass(frozen=True)
class ProposalQuestion:
    """Which skill sequences to try next (paper, Section 3.1; docs/semantics.md D16).

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


class SequenceProposer(Protocol):
    """Who proposes sequences."""

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        """Sequences, and what of the reply could not be used."""
        ...

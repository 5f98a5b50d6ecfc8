"""What the operators of a skill may say: the learner's language bias."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


@dataclass(frozen=True)
class OperatorLanguage:
    """What the operators of a skill may say.

    Attributes:
        domain: for the type hierarchy.
        skill: the skill.
        predicates: the vocabulary without tautologies.
        settings: how much they may say with it.
    """

    domain: Domain
    skill: Skill
    predicates: Sequence[Predicate]
    settings: LearnerSettings

    @property
    def arity(self) -> int:
        """Number of the skill's own parameters."""
        return len(self.skill.parameters)

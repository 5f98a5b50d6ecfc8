"""What a learned model says that a plan would change, step by step."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import TRUE
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.symbols.predicates import Literal
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class ForeseenStep:
    """A step of a plan.

    Attributes:
        instance: the skill.
        changes: what should be the case afterwards, and was not before.
    """

    instance: SkillInstance
    changes: tuple[Literal, ...]

    def __str__(self) -> str:
        changes = ", ".join(map(str, self.changes)) or "nothing that a predicate tells"
        return f"{self.instance}  ->  {changes}"


def foresee(
    learned: LearnedModel, state: AbstractState, plan: Iterable[SkillInstance]
) -> tuple[ForeseenStep, ...]:
    """What each step of a plan should change, from a state on."""
    steps = []
    for instance in plan:
        after = learned.expected(state, instance).state
        changed = np.flatnonzero(state.labels != after.labels)
        atoms = after.space.atoms
        literals = tuple(Literal(atoms[i], bool(after.labels[i] == TRUE)) for i in changed)
        steps.append(ForeseenStep(instance, literals))
        state = after
    return tuple(steps)

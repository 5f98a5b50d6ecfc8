"""The abstract model: what is learned."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from skillwrapper.symbols.operators import Operator
from skillwrapper.symbols.predicates import Predicate
from skillwrapper.world.domain import Domain


@dataclass(frozen=True)
class AbstractModel:
    """Predicates and operators over a domain (the paper's abstract transition model).

    Attributes:
        domain: types, objects and skills.
        predicates: in the order of their invention.
        operators: sorted by skill and name.
    """

    domain: Domain
    predicates: tuple[Predicate, ...]
    operators: tuple[Operator, ...]

    @cached_property
    def predicate_by_name(self) -> dict[str, Predicate]:
        """Predicates by their names."""
        return {p.name: p for p in self.predicates}

    def operators_of(self, skill: str) -> tuple[Operator, ...]:
        """The operators of one skill."""
        return tuple(o for o in self.operators if o.skill == skill)

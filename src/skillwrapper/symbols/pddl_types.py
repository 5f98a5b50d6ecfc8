"""Which object types a PDDL file can declare as types, and which become static predicates.

PDDL types form a tree and an object has one of them; ours form a graph and an object may have
several (DESIGN.md D3). The types that never overlap form the tree, the rest are unary predicates.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial

from skillwrapper.symbols.model import AbstractModel
from skillwrapper.world.types import TypeHierarchy

ROOT = "thing"
"""Root of the tree where one is needed; the ``pddl`` library refuses ``object`` as a type."""


@dataclass(frozen=True)
class PddlTypes:
    """A division of the used types into a tree and static predicates.

    Attributes:
        hierarchy: all types.
        tree: types that are written as PDDL types, general ones first; of two
            that overlap, the one declared first.
        static: types that are written as static unary predicates.
        rooted: whether something has no type of the tree, so that a common root is needed.
    """

    hierarchy: TypeHierarchy
    tree: tuple[str, ...]
    static: tuple[str, ...]
    rooted: bool

    @classmethod
    def of(cls, model: AbstractModel) -> PddlTypes:
        """Divide the types that a model uses."""
        hierarchy = model.domain.types
        variables = [hierarchy.closure(types) for types in _variable_types(model)]
        together = [frozenset(o.types) for o in model.domain.objects] + variables
        used = {name for types in _variable_types(model) for name in types}
        tree: list[str] = []
        for name in sorted(used, key=partial(_generality, hierarchy)):
            beside = {t for types in together if name in types for t in tree if t in types}
            if all(_comparable(hierarchy, name, other) for other in beside):
                tree.append(name)
        static = tuple(sorted(used - set(tree)))
        rootless = any(not types & set(tree) for types in together)
        return cls(hierarchy, tuple(tree), static, bool(static) or rootless)

    def type_of(self, types: Iterable[str]) -> str:
        """The PDDL type of something that is of all the given types."""
        closure = self.hierarchy.closure(types)
        return next((name for name in reversed(self.tree) if name in closure), ROOT)

    def static_of(self, types: Iterable[str]) -> tuple[str, ...]:
        """The static predicates that say the rest of the given types."""
        closure = self.hierarchy.closure(types)
        return self.hierarchy.most_specific(name for name in self.static if name in closure)

    def parent(self, name: str) -> str:
        """The PDDL supertype of a type of the tree, or the root."""
        above = self.hierarchy.ancestors[name] - {name}
        return next((other for other in reversed(self.tree) if other in above), ROOT)

    def may_overlap(self, first: Iterable[str], second: Iterable[str]) -> bool:
        """Whether one object can be of both."""
        one, two = self.type_of(first), self.type_of(second)
        return ROOT in {one, two} or _comparable(self.hierarchy, one, two)


def _generality(hierarchy: TypeHierarchy, name: str) -> tuple[int, int]:
    """Sorts supertypes before subtypes, and otherwise as declared."""
    return len(hierarchy.ancestors[name]), hierarchy.names.index(name)


def _comparable(hierarchy: TypeHierarchy, first: str, second: str) -> bool:
    """Whether one of two types implies the other."""
    return hierarchy.is_subtype(first, second) or hierarchy.is_subtype(second, first)


def _variable_types(model: AbstractModel) -> Iterator[tuple[str, ...]]:
    for predicate in model.predicates:
        yield from ((name,) for name in predicate.types)
    for operator in model.operators:
        yield from (variable.types for variable in operator.parameters)
        yield from (effect.quantified.types for effect in operator.conditional_effects)

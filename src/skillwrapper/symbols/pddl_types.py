"""Which object types a PDDL file can declare as types, and which become static predicates.

PDDL types form a tree and an object has one of them; ours form a graph and an object may have
several (docs/semantics.md, D3). The types that never overlap form the tree, the rest are unary
predicates. Types that nothing in the model speaks of are written as well: objects have them.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial

from skillwrapper.errors import SymbolError
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.world.types import Object, TypeHierarchy


@dataclass(frozen=True)
class PddlTypes:
    """A division of a domain's types into a tree and static predicates.

    Attributes:
        hierarchy: all types.
        tree: types that are written as PDDL types, general ones first.
        static: types that are written as static unary predicates.
        rooted: whether something has no type of the tree, so that a common root is needed.
    """

    hierarchy: TypeHierarchy
    tree: tuple[str, ...]
    static: tuple[str, ...]
    rooted: bool

    @classmethod
    def of(cls, model: AbstractModel) -> PddlTypes:
        """Divide the types; of two that overlap, one that the model uses gets into the tree."""
        hierarchy = model.domain.types
        used = frozenset(name for types in _variable_types(model) for name in types)
        together = {hierarchy.closure(types) for types in _variable_types(model)}
        together |= {frozenset(o.types) for o in model.domain.objects}
        together |= set(hierarchy.ancestors.values())
        tree: list[str] = []
        general_first = sorted(hierarchy.names, key=partial(_generality, hierarchy))
        for name in sorted(general_first, key=lambda name: name not in used):
            beside = {t for types in together if name in types for t in tree if t in types}
            if all(_comparable(hierarchy, name, other) for other in beside):
                tree.append(name)
        static = tuple(sorted(set(hierarchy.names) - set(tree)))
        rootless = any(not types & set(tree) for types in together)
        ordered = tuple(name for name in general_first if name in tree)
        return cls(hierarchy, ordered, static, bool(static) or rootless)

    def type_of(self, types: Iterable[str]) -> str | None:
        """The PDDL type of something that is of all the given types; None for the root."""
        closure = self.hierarchy.closure(types)
        return next((name for name in reversed(self.tree) if name in closure), None)

    def check_object(self, item: Object) -> None:
        """Raise ``SymbolError`` if an object is of two types that the tree keeps apart."""
        own = [name for name in self.tree if name in item.types]
        for one, other in itertools.combinations(own, 2):
            if not _comparable(self.hierarchy, one, other):
                raise SymbolError(
                    f"object '{item.name}': its types '{one}' and '{other}' never come together "
                    f"in the domain, and PDDL objects have one type; declare the object there"
                )

    def static_of(self, types: Iterable[str]) -> tuple[str, ...]:
        """The static predicates that say the rest of the given types."""
        closure = self.hierarchy.closure(types)
        return self.hierarchy.most_specific(name for name in self.static if name in closure)

    def parent(self, name: str) -> str | None:
        """The PDDL supertype of a type of the tree; None for the root."""
        return self.type_of(self.hierarchy.ancestors[name] - {name})

    def may_overlap(self, first: Iterable[str], second: Iterable[str]) -> bool:
        """Whether one object can be of both."""
        one, two = self.type_of(first), self.type_of(second)
        return one is None or two is None or _comparable(self.hierarchy, one, two)


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

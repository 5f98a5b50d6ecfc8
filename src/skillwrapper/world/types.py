"""Object types, their hierarchy, and objects."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from skillwrapper.errors import ConfigurationError, UnknownNameError


@dataclass(frozen=True)
class TypeHierarchy:
    """A directed acyclic graph of object types (docs/semantics.md D3).

    Attributes:
        parents: the direct supertypes of every type; roots have none.
        descriptions: what a type means, one sentence, may be missing.

    Raises:
        ConfigurationError: if the graph has a cycle.
        UnknownNameError: if a parent is not a type.
    """

    parents: Mapping[str, tuple[str, ...]]
    descriptions: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, parents in self.parents.items():
            for parent in parents:
                if parent not in self.parents:
                    raise UnknownNameError(f"parent type of '{name}'", parent, self.parents)
        for name in self.parents:
            self._collect_ancestors(name, ())

    @property
    def names(self) -> tuple[str, ...]:
        """All types, in the order in which they were declared."""
        return tuple(self.parents)

    @cached_property
    def ancestors(self) -> Mapping[str, frozenset[str]]:
        """For every type, itself and all its supertypes."""
        return {name: self._collect_ancestors(name, ()) for name in self.parents}

    def is_subtype(self, name: str, of: str) -> bool:
        """Whether every object of type ``name`` is also of type ``of`` (reflexive)."""
        return of in self.ancestors[name]

    def closure(self, names: Iterable[str]) -> frozenset[str]:
        """The given types with all their supertypes."""
        return frozenset(a for name in names for a in self.ancestors[name])

    def most_specific(self, names: Iterable[str]) -> tuple[str, ...]:
        """The given types without those that another of them implies, sorted."""
        chosen = frozenset(names)
        implied = {a for name in chosen for a in self.ancestors[name] if a != name}
        return tuple(sorted(chosen - implied))

    def is_tree(self) -> bool:
        """Whether no type has two direct supertypes."""
        return all(len(parents) <= 1 for parents in self.parents.values())

    def _collect_ancestors(self, name: str, path: tuple[str, ...]) -> frozenset[str]:
        if name in path:
            cycle = " -> ".join((*path[path.index(name) :], name))
            raise ConfigurationError(f"the types form a cycle: {cycle}")
        found = {name}
        for parent in self.parents[name]:
            found |= self._collect_ancestors(parent, (*path, name))
        return frozenset(found)


@dataclass(frozen=True, order=True)
class Object:
    """A thing in the scene that skills and predicates can be about.

    Attributes:
        name: unique within a domain.
        types: all its types, supertypes included, sorted.
        description: how to recognise it in a picture, may be empty.
    """

    name: str
    types: tuple[str, ...]
    description: str = field(default="", compare=False)

    def has_types(self, types: Iterable[str]) -> bool:
        """Whether the object is of every one of the given types."""
        return all(name in self.types for name in types)

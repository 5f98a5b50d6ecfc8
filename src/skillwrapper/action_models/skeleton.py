"""What is known of a planning domain before learning: types, predicates and actions' parameters."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from skillwrapper.world.types import TypeHierarchy

ROOT = "object"
"""The type of everything."""


@dataclass(frozen=True, order=True)
class TypedName:
    """A parameter, or a constant.

    Attributes:
        name: parameters start with ``?``.
        types: it is of one of these; several only where PDDL says ``either``.
    """

    name: str
    types: tuple[str, ...] = (ROOT,)


@dataclass(frozen=True, order=True)
class Schema:
    """An action or a predicate with its parameters.

    Attributes:
        name: its name.
        parameters: the parameters, in order.
    """

    name: str
    parameters: tuple[TypedName, ...] = ()


@dataclass(frozen=True, order=True)
class LiftedAtom:
    """A predicate over parameters of an action and constants of the domain.

    Attributes:
        predicate: its name.
        terms: names of parameters and constants.
    """

    predicate: str
    terms: tuple[str, ...] = ()

    def ground(self, binding: Mapping[str, str]) -> str:
        """The atom as states hold it: words with one blank between them."""
        return " ".join((self.predicate, *(binding.get(term, term) for term in self.terms)))

    def __str__(self) -> str:
        return f"({' '.join((self.predicate, *self.terms))})"


@dataclass(frozen=True)
class DomainSkeleton:
    """A domain of which preconditions and effects are to be learned.

    Attributes:
        name: its name.
        types: the types below ``object``.
        constants: objects that every problem has.
        predicates: by name.
        actions: by name.
        requirements: what the domain says it makes use of.
        functions: numeric ones, as they are declared; problems may set them, nothing is learned.
    """

    name: str
    types: TypeHierarchy
    constants: tuple[TypedName, ...] = ()
    predicates: Mapping[str, Schema] = field(default_factory=dict)
    actions: Mapping[str, Schema] = field(default_factory=dict)
    requirements: frozenset[str] = frozenset()
    functions: tuple[str, ...] = ()

    @property
    def has_negatives(self) -> bool:
        """Whether preconditions may be negative."""
        return not self.requirements.isdisjoint((":negative-preconditions", ":adl"))

    @property
    def has_equality(self) -> bool:
        """Whether preconditions may say that arguments differ."""
        return not self.requirements.isdisjoint((":equality", ":adl"))

    def fits(self, thing: TypedName, slot: TypedName) -> bool:
        """Whether whatever a name stands for may stand where a predicate takes a parameter."""
        return all(any(self._is(own, wanted) for wanted in slot.types) for own in thing.types)

    def accepts(self, kind: str, slot: TypedName) -> bool:
        """Whether an object of a type may stand where an action takes a parameter."""
        return self.fits(TypedName("", (kind,)), slot)

    def atoms_of(self, action: Schema) -> Iterator[LiftedAtom]:
        """All atoms over the action's parameters and the constants, in a fixed order."""
        things = (*action.parameters, *self.constants)
        for predicate in self.predicates.values():
            choices = [[t.name for t in things if self.fits(t, p)] for p in predicate.parameters]
            for terms in itertools.product(*choices):
                yield LiftedAtom(predicate.name, terms)

    @cached_property
    def _above(self) -> Mapping[str, frozenset[str]]:
        return self.types.ancestors

    def _is(self, own: str, wanted: str) -> bool:
        return wanted == ROOT or wanted in self._above.get(own, ())

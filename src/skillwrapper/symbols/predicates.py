"""Predicates, atoms and literals."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from skillwrapper.errors import SymbolError
from skillwrapper.world.types import Object

_NAME = re.compile(r"^[A-Za-z][A-Za-z0-9_-]*$")
WORDS_OF_LOGIC = frozenset(
    ("and", "or", "not", "imply", "implies", "if", "iff", "when", "forall", "exists", "either")
)
"""Names that no new predicate may have: formulas and replies mean something else by them."""
_ATOM = re.compile(r"\s*([^\s(),]+)\s*(?:\(([^()]*)\)\s*)?")


@dataclass(frozen=True, order=True)
class Predicate:
    """A named property or relation with a meaning that can be read off a picture.

    Two predicates are the same only if they also mean the same: labels that were read under one
    meaning say nothing of another.

    Attributes:
        name: letters, digits, ``_`` and ``-``, starting with a letter.
        types: the type of every parameter; empty for a nullary predicate.
        semantics: one sentence that says when it is true; part of the identity.

    Raises:
        SymbolError: if the name is not a name.
    """

    name: str
    types: tuple[str, ...]
    semantics: str = ""

    def __post_init__(self) -> None:
        if not _NAME.match(self.name):
            raise SymbolError(
                f"expected a predicate name of letters, digits, '_' and '-', got '{self.name}'"
            )

    @property
    def arity(self) -> int:
        """Number of parameters."""
        return len(self.types)

    @property
    def signature(self) -> str:
        """E.g. ``holding(?robot, ?pickupable)``."""
        return f"{self.name}({', '.join('?' + name for name in self.types)})"

    def groundings(self, objects: Sequence[Object]) -> tuple[Atom, ...]:
        """All ground atoms over distinct objects of the right types, in the objects' order."""
        fitting = ([o.name for o in objects if t in o.types] for t in self.types)
        return tuple(
            Atom(self.name, chosen)
            for chosen in itertools.product(*fitting)
            if len(set(chosen)) == len(chosen)
        )


@dataclass(frozen=True, order=True)
class Atom:
    """A predicate applied to terms; ground if the terms are objects, lifted if variables.

    Attributes:
        predicate: name of the predicate.
        terms: names of objects, or of variables, which start with ``?``.
    """

    predicate: str
    terms: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.predicate}({', '.join(self.terms)})"

    def substitute(self, binding: Mapping[str, str]) -> Atom:
        """The atom with every term replaced that the binding names."""
        return Atom(self.predicate, tuple(binding.get(term, term) for term in self.terms))


@dataclass(frozen=True, order=True)
class Literal:
    """An atom or its negation.

    Attributes:
        atom: the atom.
        positive: False for a negated atom.
    """

    atom: Atom
    positive: bool = True

    def __str__(self) -> str:
        return str(self.atom) if self.positive else f"not {self.atom}"

    def substitute(self, binding: Mapping[str, str]) -> Literal:
        """The literal with every term replaced that the binding names."""
        return Literal(self.atom.substitute(binding), self.positive)


def parse_atom(text: str) -> Atom:
    """The atom that its ``str`` describes, e.g. ``holding(robot, cup)``; ``dark`` is ``dark()``.

    Raises:
        SymbolError: if the text is no name with terms in parentheses.
    """
    match = _ATOM.fullmatch(text)
    terms = (match[2] or "").split(",") if match else []
    names = tuple(term.strip() for term in terms)
    if match is None or (len(names) > 1 and "" in names):
        raise SymbolError(f"expected an atom like 'holding(robot, cup)', got '{text}'")
    return Atom(match[1], tuple(name for name in names if name))


def parse_predicate(text: str) -> Predicate:
    """The predicate of a text such as ``on(?cup, ?shelf): the cup stands on the shelf``.

    Raises:
        SymbolError: if the text is none, or its name is a word of logic.
    """
    signature, _, meaning = text.partition(":")
    atom = parse_atom(signature)
    if atom.predicate.lower() in WORDS_OF_LOGIC:
        raise SymbolError(
            f"expected a predicate with a name of its own, got the word of logic '{atom.predicate}'"
        )
    types = tuple(term.removeprefix("?") for term in atom.terms)
    return Predicate(atom.predicate, types, meaning.strip())


def all_groundings(predicates: Iterable[Predicate], objects: Sequence[Object]) -> tuple[Atom, ...]:
    """The ground atoms of several predicates, in the order of the predicates."""
    return tuple(atom for predicate in predicates for atom in predicate.groundings(objects))

"""Goals: sets of ground literals, from an expression or from an abstract state."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from skillwrapper.errors import GoalError, UnknownNameError
from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols.predicates import Atom, Literal, Predicate

Goal = frozenset[Literal]

_TOKEN = re.compile(r"[(),]|[^\s(),]+")
_EXAMPLE = "e.g. (and (is_cut lettuce) (not (holding robot patty))), or is_cut(lettuce)"


def parse_goal(text: str, space: AtomSpace) -> Goal:
    """Read a goal in PDDL's style or in that of functions.

    ``(and (is_cut lettuce) (not (holding robot patty)))`` and
    ``is_cut(lettuce), not holding(robot, patty)`` are the same goal.

    Raises:
        GoalError: if it is no goal, or an atom has arguments of the wrong number or types.
        UnknownNameError: if there is no such predicate or object.
    """
    literals = frozenset(_check(literal, space) for literal in _Reader(text).read())
    for literal in sorted(literals):
        if Literal(literal.atom, not literal.positive) in literals:
            raise GoalError(f"goal: {literal.atom} is asked for both true and false; leave one out")
    return literals


def goal_from_state(space: AtomSpace, state: Labels, *, positive_only: bool = False) -> Goal:
    """What is known of an abstract state (docs/semantics.md, D12).

    Args:
        space: the ground atoms.
        state: TRUE, FALSE or UNKNOWN for every atom (shape: atoms).
        positive_only: leave out what is false, as the paper does.
    """
    chosen = state == TRUE if positive_only else state != UNKNOWN
    return frozenset(
        Literal(space.atoms[i], bool(state[i] == TRUE)) for i in np.flatnonzero(chosen)
    )


@dataclass
class _Reader:
    """A recursive reader; every method reads from ``position`` on and leaves it behind."""

    text: str

    def __post_init__(self) -> None:
        self.tokens = _TOKEN.findall(self.text)
        self.position = 0

    def read(self) -> tuple[Literal, ...]:
        literals = tuple(self._items(end=None))
        if not literals:
            raise self._error("a literal", "nothing")
        return literals

    def _items(self, end: str | None) -> Iterator[Literal]:
        """Literals up to the closing token, which is read too."""
        while self._peek() != end:
            if self._peek() in {",", "and"}:
                self.position += 1
            else:
                yield from self._item()
        self.position += 1

    def _item(self) -> tuple[Literal, ...]:
        token = self._next("a literal")
        if token == "not":
            return (self._negated(),)
        if token in {")", ",", "and"}:
            raise self._error("a literal", token)
        if token != "(":
            arguments = self._arguments() if self._peek() == "(" else ()
            return (Literal(Atom(token, arguments)),)
        if self._is_pddl_atom():
            name = self._next("a predicate")
            return (Literal(Atom(name, self._names())),)
        return tuple(self._items(end=")"))

    def _is_pddl_atom(self) -> bool:
        """Whether what follows an opening parenthesis is ``name argument ... )``."""
        name, after = (*self.tokens[self.position : self.position + 2], "", "")[:2]
        return name not in {"and", "not", "(", ")", ","} and after not in {"(", "and"}

    def _negated(self) -> Literal:
        literals = self._item()
        if len(literals) != 1:
            raise self._error("one literal after 'not'", f"{len(literals)}")
        return Literal(literals[0].atom, not literals[0].positive)

    def _arguments(self) -> tuple[str, ...]:
        self.position += 1
        return self._names()

    def _names(self) -> tuple[str, ...]:
        names = []
        while (token := self._next("an object or ')'")) != ")":
            if token == "(":
                raise self._error("an object", "(")
            if token != ",":
                names.append(token)
        return tuple(names)

    def _peek(self) -> str | None:
        return self.tokens[self.position] if self.position < len(self.tokens) else None

    def _next(self, expected: str) -> str:
        token = self._peek()
        if token is None:
            raise self._error(expected, "the end")
        self.position += 1
        return token

    def _error(self, expected: str, got: str) -> GoalError:
        return GoalError(f"goal '{self.text}': expected {expected}, got {got}; write {_EXAMPLE}")


def _check(literal: Literal, space: AtomSpace) -> Literal:
    """The literal, if its atom is one of the scene."""
    atom = literal.atom
    predicates = {p.name: p for p in space.predicates}
    if atom.predicate not in predicates:
        raise UnknownNameError("predicate", atom.predicate, predicates, "goal")
    predicate = predicates[atom.predicate]
    if len(atom.terms) != predicate.arity:
        raise GoalError(
            f"goal: expected {predicate.arity} argument(s) as in {predicate.signature}, "
            f"got {len(atom.terms)} in {atom}"
        )
    _check_objects(atom, predicate, space)
    if atom not in space.column:
        raise GoalError(f"goal: expected different objects in {atom}, got one twice")
    return literal


def _check_objects(atom: Atom, predicate: Predicate, space: AtomSpace) -> None:
    objects = {o.name: o for o in space.objects}
    for name, type_name in zip(atom.terms, predicate.types, strict=True):
        if name not in objects:
            raise UnknownNameError("object", name, objects, "goal")
        if type_name not in objects[name].types:
            fitting = [o.name for o in space.objects if type_name in o.types]
            raise GoalError(
                f"goal: expected a {type_name} in {atom}, got '{name}' "
                f"({', '.join(objects[name].types)}); there are: {', '.join(fitting) or 'none'}"
            )

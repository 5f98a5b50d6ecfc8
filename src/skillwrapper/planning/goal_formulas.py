"""Logical formulas over lifted atoms, and the sets of ground literals that make them true."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from skillwrapper.errors import GoalError
from skillwrapper.grounding import AtomSpace
from skillwrapper.symbols.predicates import Atom, Literal

_MOST_ALTERNATIVES = 1_000
_MOST_COMBINED = 200_000
_MOST_CONDITIONS = 100_000


@dataclass(frozen=True)
class Condition:
    """An atom over objects and variables; one that is no ground atom of the scene is false."""

    atom: Atom


@dataclass(frozen=True)
class Equality:
    """Whether two terms stand for one object."""

    first: str
    second: str


@dataclass(frozen=True)
class Negation:
    """What is true if its part is false."""

    part: Formula


@dataclass(frozen=True)
class Junction:
    """All of its parts (``and``), or one of them (``or``)."""

    every: bool
    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Quantification:
    """A part for all (``forall``) or for some (``exists``) choice of objects for variables.

    Attributes:
        every: for all choices.
        choices: variables with the names of the objects that they can stand for.
        part: what is said of them.
    """

    every: bool
    choices: tuple[tuple[str, tuple[str, ...]], ...]
    part: Formula


Formula = Condition | Equality | Negation | Junction | Quantification

_Alternative = frozenset[int]
"""The columns of atoms that must be true, and the complements (``~``) of those to be false."""


def alternatives(formula: Formula, space: AtomSpace) -> tuple[frozenset[Literal], ...]:
    """The smallest sets of ground literals, one of which must hold for the formula to be true.

    Args:
        formula: a formula without free variables.
        space: the ground atoms of the scene.

    Raises:
        GoalError: if there is no such set, or if there are too many.
    """
    expansion = _Expansion(space)
    found = expansion.of(formula, True, {})
    if not found:
        raise GoalError(f"goal: {expansion.impossible}")
    by_size = sorted(found, key=lambda alternative: (len(alternative), sorted(alternative)))
    return tuple(
        frozenset(Literal(space.atoms[c if c >= 0 else ~c], c >= 0) for c in alternative)
        for alternative in by_size
    )


@dataclass
class _Expansion:
    """Pushes negations inwards, replaces variables by objects, and distributes ands over ors."""

    space: AtomSpace
    conditions: int = 0
    clash: Atom | None = field(default=None)

    @property
    def impossible(self) -> str:
        """Why no state can meet the goal."""
        if self.clash is not None:
            return f"{self.clash} is asked for both true and false; leave one out"
        return "no state of this scene can meet it; look at its equalities and quantifiers"

    def of(
        self, formula: Formula, positive: bool, binding: Mapping[str, str]
    ) -> list[_Alternative]:
        match formula:
            case Condition(atom):
                return self._condition(atom.substitute(binding), positive)
            case Equality(first, second):
                same = binding.get(first, first) == binding.get(second, second)
                return [frozenset()] if same is positive else []
            case Negation(part):
                return self.of(part, not positive, binding)
            case Junction(every, parts):
                found = (self.of(part, positive, binding) for part in parts)
                return self._all(found) if every is positive else self._some(found)
            case Quantification(every, _, part):
                found = (self.of(part, positive, b) for b in _bindings(formula, binding))
                return self._all(found) if every is positive else self._some(found)

    def _condition(self, atom: Atom, positive: bool) -> list[_Alternative]:
        self.conditions += 1
        if self.conditions > _MOST_CONDITIONS:
            raise GoalError(f"goal: it speaks of more than {_MOST_CONDITIONS:,} ground atoms")
        column = self.space.column.get(atom)
        if column is None:
            return [] if positive else [frozenset()]
        return [frozenset({column if positive else ~column})]

    def _some(self, many: Iterable[list[_Alternative]]) -> list[_Alternative]:
        return _smallest(set(itertools.chain.from_iterable(many)))

    def _all(self, many: Iterable[list[_Alternative]]) -> list[_Alternative]:
        found: list[_Alternative] = [frozenset()]
        for one in many:
            if len(found) * len(one) > _MOST_COMBINED:
                raise _too_many()
            pairs = itertools.product(found, one)
            found = _smallest({a | b for a, b in pairs if self._go_together(a, b)})
        return found

    def _go_together(self, first: _Alternative, second: _Alternative) -> bool:
        for column in second:
            if ~column in first:
                self.clash = self.space.atoms[max(column, ~column)]
                return False
        return True


def _bindings(formula: Quantification, binding: Mapping[str, str]) -> Iterator[Mapping[str, str]]:
    variables = [variable for variable, _ in formula.choices]
    for chosen in itertools.product(*(names for _, names in formula.choices)):
        yield {**binding, **dict(zip(variables, chosen, strict=True))}


def _smallest(found: set[_Alternative]) -> list[_Alternative]:
    """Those of which no other one is a part."""
    if len(found) > _MOST_COMBINED:
        raise _too_many()
    kept: list[_Alternative] = []
    for alternative in sorted(found, key=len):
        if not any(smaller <= alternative for smaller in kept):
            kept.append(alternative)
            if len(kept) > _MOST_ALTERNATIVES:
                raise _too_many()
    return kept


def _too_many() -> GoalError:
    return GoalError(
        f"goal: there are more than {_MOST_ALTERNATIVES:,} ways to meet it, because of its "
        f"'or' and 'exists'; ask for less at once"
    )

"""Lifted operators (the paper's Section 2, with docs/semantics.md, D1, D2, D4 and D5)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from skillwrapper.errors import SymbolError
from skillwrapper.symbols.predicates import Atom, Literal


@dataclass(frozen=True, order=True)
class Variable:
    """A typed parameter of an operator.

    Attributes:
        name: starts with ``?``.
        types: an object fits if it is of all these types; sorted, none implies another.
    """

    name: str
    types: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.name}: {' and '.join(self.types)}" if self.types else self.name


@dataclass(frozen=True, order=True)
class Absence:
    """Universal absence: no other object stands in the relation (docs/semantics.md, D2).

    ``Absence(Atom("on", ("?other", "?item")), ("?other",))`` says that no object other than
    the operator's own parameters is on ``?item``; the operator's parameters are spoken of by
    plain literals.

    Attributes:
        atom: an atom of which some terms are quantified and the others operator parameters.
        quantified: the quantified terms; their types are those of the predicate.
    """

    atom: Atom
    quantified: tuple[str, ...]

    def __str__(self) -> str:
        return f"no other {', '.join(self.quantified)}: {self.atom}"


Condition = Literal | Absence | Variable
"""What an operator asks for; a variable asks for the types of what stands for it."""


@dataclass(frozen=True, order=True)
class ConditionalEffect:
    """A change of every other object that meets a condition (docs/semantics.md, D5).

    Attributes:
        quantified: the variable that ranges over all objects but the skill's own arguments; what
            stands for a context parameter is no exception.
        condition: literals that the object must meet before.
        effect: what then becomes true (positive) or false (negative).
    """

    quantified: Variable
    condition: tuple[Literal, ...]
    effect: Literal

    def __str__(self) -> str:
        when = " and ".join(map(str, self.condition)) or "always"
        return f"every other {self.quantified.name} with {when}: {self.effect}"


@dataclass(frozen=True)
class Operator:
    """When a skill works in one way, and what it then changes.

    Different parameters stand for different objects (docs/semantics.md, D4).

    Attributes:
        name: unique in a model, e.g. ``Pick_1``.
        skill: name of the skill.
        parameters: the skill's own parameters first, then context objects.
        arity: how many of the parameters are the skill's own.
        preconditions: literals over the parameters.
        absences: universal absences.
        add_effects: atoms over the parameters that become true.
        delete_effects: atoms over the parameters that become false.
        conditional_effects: changes of every object that meets a condition.

    Raises:
        SymbolError: if a term is no parameter, or an atom is both added and deleted.
    """

    name: str
    skill: str
    parameters: tuple[Variable, ...]
    arity: int
    preconditions: frozenset[Literal]
    absences: frozenset[Absence]
    add_effects: frozenset[Atom]
    delete_effects: frozenset[Atom]
    conditional_effects: frozenset[ConditionalEffect] = frozenset()

    def __post_init__(self) -> None:
        names = {v.name for v in self.parameters}
        atoms = {literal.atom for literal in self.preconditions}
        for atom in atoms | self.add_effects | self.delete_effects:
            for term in atom.terms:
                if term not in names:
                    raise SymbolError(
                        f"operator {self.name}: expected '{term}' of {atom} among its "
                        f"parameters {sorted(names)}"
                    )
        both = self.add_effects & self.delete_effects
        if both:
            raise SymbolError(f"operator {self.name}: {min(both)} is both added and deleted")

    @property
    def context(self) -> tuple[Variable, ...]:
        """The parameters that are not the skill's own."""
        return self.parameters[self.arity :]

    @property
    def conditions(self) -> frozenset[Condition]:
        """All that it asks for."""
        return self.preconditions | self.absences | frozenset(self.parameters)

    def renamed(self, name: str) -> Operator:
        """The same operator under another name."""
        return replace(self, name=name)

    @property
    def predicates(self) -> frozenset[str]:
        """The names of all predicates that it speaks of."""
        literals = set(self.preconditions)
        for effect in self.conditional_effects:
            literals.update((*effect.condition, effect.effect))
        atoms = {x.atom for x in literals} | {x.atom for x in self.absences}
        return frozenset(a.predicate for a in atoms | self.add_effects | self.delete_effects)

    def reworded(self, names: Mapping[str, str]) -> Operator:
        """The same operator with other names of predicates, by those that it has."""

        def atom(one: Atom) -> Atom:
            return replace(one, predicate=names.get(one.predicate, one.predicate))

        def literal(one: Literal) -> Literal:
            return replace(one, atom=atom(one.atom))

        return replace(
            self,
            preconditions=frozenset(map(literal, self.preconditions)),
            absences=frozenset(replace(a, atom=atom(a.atom)) for a in self.absences),
            add_effects=frozenset(map(atom, self.add_effects)),
            delete_effects=frozenset(map(atom, self.delete_effects)),
            conditional_effects=frozenset(
                replace(e, condition=tuple(map(literal, e.condition)), effect=literal(e.effect))
                for e in self.conditional_effects
            ),
        )

"""Ground operators as arrays: applicability and successors of many abstract states at once.

An abstract state is a row of ``int8`` over the ground atoms of a vocabulary:
``TRUE`` (1), ``FALSE`` (0) or ``UNKNOWN`` (-1), see DESIGN.md D10.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.atom_index import AtomIndex, Columns
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, ConditionalEffect, Operator
from skillwrapper.symbols.predicates import Atom, Literal, Predicate, all_groundings
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object

TRUE, FALSE, UNKNOWN = 1, 0, -1
Labels = NDArray[np.int8]


@dataclass(frozen=True)
class AtomSpace:
    """The ground atoms of a vocabulary over the objects of a scene, one column each.

    Attributes:
        predicates: the vocabulary.
        objects: the objects of the scene.
    """

    predicates: tuple[Predicate, ...]
    objects: tuple[Object, ...]

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.predicates, self.objects))

    @cached_property
    def atoms(self) -> tuple[Atom, ...]:
        """The ground atoms in the order of their columns."""
        return all_groundings(self.predicates, self.objects)

    @cached_property
    def column(self) -> dict[Atom, int]:
        """The column of every ground atom."""
        return {atom: number for number, atom in enumerate(self.atoms)}

    @cached_property
    def index(self) -> AtomIndex:
        """Finds columns by the numbers of objects."""
        return AtomIndex(self.predicates, self.objects)

    @cached_property
    def atoms_of(self) -> dict[str, tuple[Atom, ...]]:
        """The ground atoms of every predicate."""
        return {p.name: p.groundings(self.objects) for p in self.predicates}

    def columns(self, atoms: Iterable[Atom]) -> Columns:
        """Columns of several atoms, sorted."""
        return np.array(sorted(self.column[a] for a in atoms), dtype=np.intp)

    def true_atoms(self, state: Labels) -> frozenset[Atom]:
        """The atoms that are true in a state (shape: atoms)."""
        return frozenset(self.atoms[i] for i in np.flatnonzero(state == TRUE))


@dataclass(frozen=True)
class GroundConditionalEffect:
    """One object's share of a conditional effect: columns that must hold, column that changes."""

    required_true: Columns
    required_false: Columns
    column: int
    becomes: int


@dataclass(frozen=True)
class GroundOperator:
    """An operator with objects for its parameters (the paper's abstract action).

    Attributes:
        operator: the lifted operator.
        arguments: names of the objects.
        required_true: columns that must be true.
        required_false: columns that must be false.
        added: columns that become true.
        deleted: columns that become false.
        conditional: conditional changes.
    """

    operator: Operator
    arguments: tuple[str, ...]
    required_true: Columns
    required_false: Columns
    added: Columns
    deleted: Columns
    conditional: tuple[GroundConditionalEffect, ...] = ()

    @property
    def instance(self) -> SkillInstance:
        """The skill instance it belongs to."""
        return SkillInstance(self.operator.skill, self.arguments[: self.operator.arity])

    def applicability(self, states: Labels) -> Labels:
        """For states (n, atoms): TRUE, FALSE or UNKNOWN (n,) in Kleene's logic."""
        positive, negative = states[:, self.required_true], states[:, self.required_false]
        violated = (positive == FALSE).any(axis=1) | (negative == TRUE).any(axis=1)
        met = (positive == TRUE).all(axis=1) & (negative == FALSE).all(axis=1)
        return np.where(violated, FALSE, np.where(met, TRUE, UNKNOWN)).astype(np.int8)

    def effects(self, states: Labels) -> Labels:
        """The effect in each state (n, atoms): 1 added, -1 deleted, 0 neither."""
        effects = np.zeros_like(states)
        for effect in self.conditional:
            meets = (states[:, effect.required_true] == TRUE).all(axis=1)
            meets &= (states[:, effect.required_false] == FALSE).all(axis=1)
            effects[meets, effect.column] = 1 if effect.becomes == TRUE else -1
        effects[:, self.deleted] = -1
        effects[:, self.added] = 1
        return effects

    def apply(self, states: Labels) -> Labels:
        """The next states (n, atoms), whether applicable or not."""
        effects = self.effects(states)
        following: Labels = np.where(effects == 0, states, effects > 0).astype(np.int8)
        return following


@dataclass(frozen=True)
class GroundModel:
    """All ground operators of a model over the objects of a scene.

    Attributes:
        space: the ground atoms.
        operators: ground operators by skill instance; an instance without any is missing.
    """

    space: AtomSpace
    operators: dict[SkillInstance, tuple[GroundOperator, ...]]

    @classmethod
    def of(cls, model: AbstractModel, objects: Sequence[Object]) -> GroundModel:
        """Ground a model over objects."""
        return cls.from_operators(model.operators, AtomSpace(model.predicates, tuple(objects)))

    @classmethod
    def from_operators(cls, operators: Iterable[Operator], space: AtomSpace) -> GroundModel:
        """Ground operators over an atom space."""
        grounded: dict[SkillInstance, list[GroundOperator]] = {}
        for operator in operators:
            for ground in ground_operator(operator, space):
                grounded.setdefault(ground.instance, []).append(ground)
        return cls(space, {instance: tuple(found) for instance, found in grounded.items()})

    def applicable(self, instance: SkillInstance, state: Labels) -> tuple[GroundOperator, ...]:
        """The ground operators of an instance that surely apply in one state (atoms,)."""
        rows = state[np.newaxis]
        return tuple(
            g for g in self.operators.get(instance, ()) if g.applicability(rows)[0] == TRUE
        )


def ground_operator(operator: Operator, space: AtomSpace) -> Iterator[GroundOperator]:
    """All bindings of an operator's parameters to distinct objects of the right types."""
    choices = [[o for o in space.objects if o.has_types(v.types)] for v in operator.parameters]
    for chosen in itertools.product(*choices):
        names = tuple(o.name for o in chosen)
        if len(set(names)) == len(names):
            ground = _bind(operator, names, space)
            if ground is not None:
                yield ground


def _bind(operator: Operator, names: tuple[str, ...], space: AtomSpace) -> GroundOperator | None:
    """The ground operator, or None if it can never apply."""
    binding = dict(zip((v.name for v in operator.parameters), names, strict=True))
    required = [literal.substitute(binding) for literal in operator.preconditions]
    true = {literal.atom for literal in required if literal.positive}
    false = {literal.atom for literal in required if not literal.positive}
    for absence in operator.absences:
        false.update(absent_atoms(absence, binding, space))
    if true & false or any(atom not in space.column for atom in true):
        return None
    # An atom that is no grounding (wrong types) is false in every state.
    false = {atom for atom in false if atom in space.column}
    added = [atom.substitute(binding) for atom in operator.add_effects]
    deleted = [atom.substitute(binding) for atom in operator.delete_effects]
    if any(atom not in space.column for atom in (*added, *deleted)):
        return None
    return GroundOperator(
        operator,
        names,
        space.columns(true),
        space.columns(false),
        space.columns(added),
        space.columns(deleted),
        tuple(
            effect
            for lifted in sorted(operator.conditional_effects)
            for effect in _bind_conditional(lifted, binding, names[: operator.arity], space)
        ),
    )


def absent_atoms(absence: Absence, binding: dict[str, str], space: AtomSpace) -> Iterator[Atom]:
    """The ground atoms that a universal absence says are false, under a binding."""
    pattern = absence.atom.substitute(binding)
    taken = set(binding.values())
    for atom in space.atoms_of.get(pattern.predicate, ()):
        pairs = zip(pattern.terms, atom.terms, strict=True)
        if all(
            (got not in taken) if want in absence.quantified else want == got for want, got in pairs
        ):
            yield atom


def _bind_conditional(
    effect: ConditionalEffect, binding: dict[str, str], arguments: Sequence[str], space: AtomSpace
) -> Iterator[GroundConditionalEffect]:
    for other in space.objects:
        if other.name in arguments or not other.has_types(effect.quantified.types):
            continue
        extended = {**binding, effect.quantified.name: other.name}
        condition = [literal.substitute(extended) for literal in effect.condition]
        changed = effect.effect.substitute(extended)
        known = all(literal.atom in space.column for literal in condition if literal.positive)
        if known and changed.atom in space.column:
            yield GroundConditionalEffect(
                _columns_of(condition, space, positive=True),
                _columns_of(condition, space, positive=False),
                space.column[changed.atom],
                TRUE if changed.positive else FALSE,
            )


def _columns_of(literals: Iterable[Literal], space: AtomSpace, *, positive: bool) -> Columns:
    return space.columns(
        literal.atom
        for literal in literals
        if literal.positive is positive and literal.atom in space.column
    )

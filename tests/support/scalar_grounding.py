"""Operators bound one after the other to all objects: slow, and obviously what is meant.

The engine of ``skillwrapper.grounding`` is held against it.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.grounding.atom_index import Columns
from skillwrapper.symbols import Absence, Atom, ConditionalEffect, Literal, Operator
from skillwrapper.world import SkillInstance


@dataclass(frozen=True)
class ScalarConditionalEffect:
    """One object's share of a conditional effect: columns that must hold, column that changes."""

    required_true: Columns
    required_false: Columns
    column: int
    becomes: int


@dataclass(frozen=True)
class ScalarOperator:
    """An operator with objects for its parameters.

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
    conditional: tuple[ScalarConditionalEffect, ...] = ()

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
        effects[(effects > 0) & (states == TRUE)] = 0
        effects[(effects < 0) & (states == FALSE)] = 0
        effects[:, self.deleted] = -1
        effects[:, self.added] = 1
        return effects

    def apply(self, states: Labels) -> Labels:
        """The next states (n, atoms), whether applicable or not."""
        effects = self.effects(states)
        following: Labels = np.where(effects == 0, states, effects > 0).astype(np.int8)
        return following


def ground_operator(operator: Operator, space: AtomSpace) -> Iterator[ScalarOperator]:
    """All bindings of an operator's parameters to distinct objects of the right types."""
    choices = [[o for o in space.objects if o.has_types(v.types)] for v in operator.parameters]
    for chosen in itertools.product(*choices):
        names = tuple(o.name for o in chosen)
        if len(set(names)) == len(names):
            ground = bind(operator, names, space)
            if ground is not None:
                yield ground


def bind(operator: Operator, names: tuple[str, ...], space: AtomSpace) -> ScalarOperator | None:
    """The ground operator, or None if it can never apply."""
    binding = dict(zip((v.name for v in operator.parameters), names, strict=True))
    required = [literal.substitute(binding) for literal in operator.preconditions]
    true = {literal.atom for literal in required if literal.positive}
    false = {literal.atom for literal in required if not literal.positive}
    for absence in operator.absences:
        false.update(absent_atoms(absence, binding, space))
    if any(atom not in space.column for atom in true):
        return None
    # An atom that is no grounding (wrong types) is false in every state.
    false = {atom for atom in false if atom in space.column}
    added = [atom.substitute(binding) for atom in operator.add_effects]
    deleted = [atom.substitute(binding) for atom in operator.delete_effects]
    if any(atom not in space.column for atom in (*added, *deleted)):
        return None
    return ScalarOperator(
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
) -> Iterator[ScalarConditionalEffect]:
    for other in space.objects:
        if other.name in arguments or not other.has_types(effect.quantified.types):
            continue
        extended = {**binding, effect.quantified.name: other.name}
        condition = [literal.substitute(extended) for literal in effect.condition]
        changed = effect.effect.substitute(extended)
        known = all(literal.atom in space.column for literal in condition if literal.positive)
        if known and changed.atom in space.column:
            yield ScalarConditionalEffect(
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

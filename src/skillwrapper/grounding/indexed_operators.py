"""An operator over the ground atoms of a scene: what it asks for and changes, binding by binding.

A binding is a row of numbers of objects, one for each parameter of the operator; many are looked
at together, each in an abstract state of its own.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.atom_index import ANY, AtomPatterns, Columns, taken_objects
from skillwrapper.grounding.atom_space import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols import Absence, Atom, ConditionalEffect, Literal, Operator, Variable
from skillwrapper.symbols.operators import Condition


@dataclass(frozen=True)
class IndexedOperator:
    """An operator whose atoms are found by numbers of objects.

    Attributes:
        operator: the operator.
        space: the ground atoms.
        doubtful: parameters whose types are conditions of their own, which may be unmet; the
            types of all others always hold.
    """

    operator: Operator
    space: AtomSpace
    doubtful: frozenset[Variable] = frozenset()

    @cached_property
    def literals(self) -> tuple[Literal, ...]:
        """The plain preconditions, sorted."""
        return tuple(sorted(self.operator.preconditions))

    @cached_property
    def conditions(self) -> tuple[Condition, ...]:
        """All that may be unmet: literals, absences, doubtful types."""
        types = (v for v in self.operator.parameters if v in self.doubtful)
        return (*self.literals, *sorted(self.operator.absences), *types)

    @cached_property
    def fits(self) -> NDArray[np.bool_]:
        """Which objects are of the types of a parameter (parameters, objects)."""
        types = [self.space.index.of_types(v.types) for v in self.operator.parameters]
        return np.array(types, dtype=bool).reshape(len(types), len(self.space.objects))

    @cached_property
    def allowed(self) -> NDArray[np.bool_]:
        """Which objects may stand for a parameter (parameters, objects)."""
        doubtful = np.array([v in self.doubtful for v in self.operator.parameters], dtype=bool)
        allowed: NDArray[np.bool_] = self.fits | doubtful[:, np.newaxis]
        return allowed

    @cached_property
    def wanted(self) -> Labels:
        """The label that each literal asks for (literals,)."""
        return np.array([TRUE if x.positive else FALSE for x in self.literals], dtype=np.int8)

    def patterns(self, atoms: Iterable[Atom], quantified: Sequence[str] = ()) -> AtomPatterns:
        """Compile atoms over the parameters.

        The first quantified term becomes ``ANY``, further ones positions behind the parameters.
        """
        names = [v.name for v in self.operator.parameters]
        position = {name: number for number, name in enumerate([*names, *quantified[1:]])}
        position |= dict.fromkeys(quantified[:1], ANY)
        lifted = [(a.predicate, tuple(position[t] for t in a.terms)) for a in atoms]
        return self.space.index.patterns(lifted, len(names) + len(quantified[1:]))

    @cached_property
    def literal_patterns(self) -> AtomPatterns:
        """The atoms of the literals."""
        return self.patterns(literal.atom for literal in self.literals)

    @cached_property
    def changes(self) -> tuple[Literal, ...]:
        """What becomes false, then what becomes true, each sorted."""
        deleted = [Literal(atom, False) for atom in sorted(self.operator.delete_effects)]
        return (*deleted, *(Literal(atom) for atom in sorted(self.operator.add_effects)))

    @cached_property
    def _changed_patterns(self) -> AtomPatterns:
        return self.patterns(change.atom for change in self.changes)

    def changed_columns(self, objects: Columns) -> tuple[Columns, Columns]:
        """Columns that are added and that are deleted (bindings, atoms); -1 for no grounding."""
        columns = self.space.index.columns(self._changed_patterns, objects)
        deleted = len(self.operator.delete_effects)
        return columns[:, deleted:], columns[:, :deleted]

    def possible_changes(self, objects: Columns) -> tuple[Columns, Columns]:
        """Columns (n,) that some binding may add, and that some may delete, also on conditions."""
        added, deleted = (columns.ravel() for columns in self.changed_columns(objects))
        for effect in self.operator.conditional_effects:
            _, changed = self.condition_columns(effect, objects)
            found = changed[changed >= 0]
            if effect.effect.positive:
                added = np.append(added, found)
            else:
                deleted = np.append(deleted, found)
        return added, deleted

    def absent_columns(self, absence: Absence, objects: Columns) -> Columns:
        """Columns (bindings, atoms) that an absence says are false; -1 for none."""
        size, further = len(self.space.objects), len(absence.quantified) - 1
        patterns = self.patterns([absence.atom], absence.quantified)
        taken = taken_objects(objects, size)
        found = []
        for others in itertools.permutations(range(size), max(0, further)):
            extended = np.hstack([objects, np.tile(np.array(others, np.intp), (len(objects), 1))])
            columns = self.space.index.open_columns(patterns, extended)[:, 0]
            used = taken | taken[:, list(others)].any(axis=1, keepdims=True)
            used[:, list(others)] = True
            found.append(np.where(used, -1, columns))
        return np.hstack(found)

    def met(self, states: AbstractStates, rows: NDArray[np.intp], objects: Columns) -> Labels:
        """Whether each condition is met (bindings, conditions): TRUE, FALSE or UNKNOWN.

        Args:
            states: abstract states.
            rows: the state (bindings,) of every binding.
            objects: the bindings (bindings, parameters).
        """
        columns = self.space.index.columns(self.literal_patterns, objects)
        values = states.at(rows, columns)
        met = [np.where(values == UNKNOWN, UNKNOWN, values == self.wanted)]
        for absence in sorted(self.operator.absences):
            met.append(absent(states.at(rows, self.absent_columns(absence, objects)))[:, None])
        for place, variable in enumerate(self.operator.parameters):
            if variable in self.doubtful:
                met.append(self.fits[place, objects[:, place]][:, None])
        return np.hstack(met).astype(np.int8)

    def effects(self, states: AbstractStates, rows: NDArray[np.intp], objects: Columns) -> Labels:
        """The effect of every binding in its state (bindings, atoms): 1 added, -1 deleted, or 0.

        Whether a binding is applicable is not asked. What is added wins over what is deleted, and
        both over what changes on a condition; a condition that is not known to hold does not. On a
        condition nothing changes that is so already.
        """
        effects = np.zeros((len(objects), states.labels.shape[1]), dtype=np.int8)
        for effect in sorted(self.operator.conditional_effects):
            self._add_conditional(effects, effect, states, rows, objects)
        if self.operator.conditional_effects:
            now = states.labels[rows]
            effects[((effects > 0) & (now == TRUE)) | ((effects < 0) & (now == FALSE))] = 0
        added, deleted = self.changed_columns(objects)
        np.put_along_axis(effects, deleted, -1, axis=1)
        np.put_along_axis(effects, added, 1, axis=1)
        return effects

    def successors(
        self, states: AbstractStates, rows: NDArray[np.intp], objects: Columns
    ) -> Labels:
        """The next state of every binding (bindings, atoms), whether applicable or not."""
        effects = self.effects(states, rows, objects)
        after: Labels = np.where(effects == 0, states.labels[rows], effects > 0).astype(np.int8)
        return after

    def condition_columns(
        self, effect: ConditionalEffect, objects: Columns
    ) -> tuple[Columns, Columns]:
        """A conditional effect for every binding and every object in turn.

        Returns:
            The columns (bindings, objects, literals) of its condition, in its order, and the
            column (bindings, objects) that changes; -1 for an object over which it does not range.
        """
        index, quantified = self.space.index, (effect.quantified.name,)
        atoms = [literal.atom for literal in effect.condition]
        condition = index.open_columns(self.patterns(atoms, quantified), objects)
        condition = condition.transpose(0, 2, 1)
        changed = index.open_columns(self.patterns([effect.effect.atom], quantified), objects)[:, 0]
        positive = [n for n, literal in enumerate(effect.condition) if literal.positive]
        ranges = ~taken_objects(objects[:, : self.operator.arity], len(self.space.objects))
        ranges &= index.of_types(effect.quantified.types)
        ranges &= (condition[:, :, positive] >= 0).all(axis=2)
        return condition, np.where(ranges, changed, -1)

    def _add_conditional(
        self,
        effects: Labels,
        effect: ConditionalEffect,
        states: AbstractStates,
        rows: NDArray[np.intp],
        objects: Columns,
    ) -> None:
        condition, changed = self.condition_columns(effect, objects)
        wanted = [TRUE if literal.positive else FALSE for literal in effect.condition]
        meets = (states.at(rows, condition) == wanted).all(axis=2) & (changed >= 0)
        binding, other = np.nonzero(meets)
        effects[binding, changed[binding, other]] = 1 if effect.effect.positive else -1


def absent(labels: Labels) -> Labels:
    """Whether all labels (bindings, atoms) are false (bindings,): TRUE, FALSE or UNKNOWN."""
    unsure = np.where((labels == UNKNOWN).any(axis=1), UNKNOWN, TRUE)
    return np.where((labels == TRUE).any(axis=1), FALSE, unsure).astype(np.int8)

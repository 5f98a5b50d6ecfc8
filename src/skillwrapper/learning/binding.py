"""Operators bound to the objects of recorded skill instances, all bindings at once as arrays.

The same meaning as ``grounding.ground``, which binds one after the other to objects of any kind:
here only bindings are made whose skill instance was executed, and applied to its transitions.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, Labels
from skillwrapper.grounding.atom_index import ANY, AtomPatterns, Columns, taken_objects
from skillwrapper.symbols import Atom, ConditionalEffect, Operator
from skillwrapper.symbols.operators import Variable
from skillwrapper.transitions.tables import SkillTable

_BLOCK = 8192
"""So many pairs of a binding and a transition are looked at together, to bound the memory."""


@dataclass(frozen=True)
class BoundCondition:
    """A conditional effect for every binding and every other object.

    Attributes:
        required_true: columns (bindings, objects, literals) that must be true.
        required_false: columns that must be false.
        changed: the column (bindings, objects) that changes; -1 for objects it does not range over.
        sign: 1 if it becomes true, -1 if false.
    """

    required_true: Columns
    required_false: Columns
    changed: Columns
    sign: int


@dataclass(frozen=True)
class BoundOperator:
    """All bindings of an operator's parameters that belong to recorded skill instances.

    Attributes:
        table: the transitions.
        which: the skill instance (bindings,) of every binding.
        required_true: columns (bindings, literals) that must be true.
        required_false: columns that must be false; -1 for none.
        added: columns that become true.
        deleted: columns that become false.
        conditions: conditional effects.
    """

    table: SkillTable
    which: NDArray[np.intp]
    required_true: Columns
    required_false: Columns
    added: Columns
    deleted: Columns
    conditions: tuple[BoundCondition, ...]

    def pairs(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Every binding with every transition of its skill instance: (bindings, rows)."""
        order = np.argsort(self.table.which, kind="stable")
        count = np.bincount(self.table.which, minlength=len(self.table.instances))
        own = count[self.which]
        binding = np.repeat(np.arange(len(self.which)), own)
        within = np.arange(len(binding)) - np.repeat(np.cumsum(own) - own, own)
        first = (np.cumsum(count) - count)[self.which]
        return binding, order[np.repeat(first, own) + within]

    def applicability(self, binding: NDArray[np.intp], rows: NDArray[np.intp]) -> Labels:
        """For pairs of bindings and rows (pairs,): TRUE, FALSE or UNKNOWN in Kleene's logic."""
        verdict = np.empty(len(rows), dtype=np.int8)
        for block in _blocks(len(rows)):
            own, states = binding[block], rows[block, np.newaxis]
            positive = self.table.padded[states, self.required_true[own]]
            negative = self.table.padded[states, self.required_false[own]]
            violated = (positive == FALSE).any(axis=1) | (negative == TRUE).any(axis=1)
            unknown = (positive == UNKNOWN).any(axis=1) | (negative == UNKNOWN).any(axis=1)
            verdict[block] = np.where(violated, FALSE, np.where(unknown, UNKNOWN, TRUE))
        return verdict

    def makes_change(self, binding: NDArray[np.intp], rows: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Whether the whole known change of the rows is the effect of their bindings (pairs,)."""
        table = self.table
        same = np.empty(len(rows), dtype=bool)
        for block in _blocks(len(rows)):
            own = rows[block]
            effects = self.effects(binding[block], own)
            wrong = (effects != table.change[own]) & ~table.undetermined[own]
            same[block] = ~wrong.any(axis=1)
        return same

    def mispredicts(
        self,
        binding: NDArray[np.intp],
        rows: NDArray[np.intp],
        excused: NDArray[np.bool_],
    ) -> NDArray[np.bool_]:
        """Whether the states after the rows differ from those that their bindings predict.

        Args:
            binding: of every pair.
            rows: of every pair.
            excused: atoms (n, atoms) that do not count.
        """
        table = self.table
        wrong = np.empty(len(rows), dtype=bool)
        for block in _blocks(len(rows)):
            own = rows[block]
            effects = self.effects(binding[block], own)
            predicted = np.where(effects == 0, table.before[own], effects > 0)
            wrong[block] = ((predicted != table.after[own]) & ~excused[own]).any(axis=1)
        return wrong

    def effects(self, binding: NDArray[np.intp], rows: NDArray[np.intp]) -> Labels:
        """The effect (pairs, atoms): 1 added, -1 deleted, 0 neither."""
        effects = np.zeros((len(rows), self.table.padded.shape[1]), dtype=np.int8)
        for condition in self.conditions:
            self._add_conditional(effects, condition, binding, rows)
        np.put_along_axis(effects, self.deleted[binding], -1, axis=1)
        np.put_along_axis(effects, self.added[binding], 1, axis=1)
        return effects[:, :-1]

    def _add_conditional(
        self,
        effects: Labels,
        condition: BoundCondition,
        binding: NDArray[np.intp],
        rows: NDArray[np.intp],
    ) -> None:
        states = rows[:, np.newaxis, np.newaxis]
        positive = self.table.padded[states, condition.required_true[binding]]
        negative = self.table.padded[states, condition.required_false[binding]]
        meets = (positive == TRUE).all(axis=2)
        meets &= ~((negative == TRUE) | (negative == UNKNOWN)).any(axis=2)
        changed = condition.changed[binding]
        pair, other = np.nonzero(meets & (changed >= 0))
        effects[pair, changed[pair, other]] = condition.sign


def bind_operator(operator: Operator, table: SkillTable) -> BoundOperator:
    """Bind an operator to the objects of a table."""
    index = table.space.index
    position = {v.name: n for n, v in enumerate(operator.parameters)}
    size = len(position)

    def compile_atoms(atoms: Iterable[Atom]) -> AtomPatterns:
        """Over the operator's parameters; any other term is quantified."""
        found = ((a.predicate, tuple(position.get(t, ANY) for t in a.terms)) for a in atoms)
        return index.patterns(found, size)

    which, bindings = _bindings(operator.parameters, operator.arity, table)
    required = [compile_atoms(x.atom for x in operator.preconditions if x.positive)]
    required += [compile_atoms(operator.add_effects), compile_atoms(operator.delete_effects)]
    columns = [index.columns(patterns, bindings) for patterns in required]
    possible = np.logical_and.reduce([(found >= 0).all(axis=1) for found in columns])
    which, bindings = which[possible], bindings[possible]
    true, added, deleted = (found[possible] for found in columns)
    taken = taken_objects(bindings, len(table.space.objects))
    literals = compile_atoms(x.atom for x in operator.preconditions if not x.positive)
    absent = index.open_columns(compile_atoms(x.atom for x in operator.absences), bindings)
    absent[np.broadcast_to(taken[:, np.newaxis, :], absent.shape)] = -1
    absent = absent.reshape(len(bindings), absent.shape[1] * absent.shape[2])
    false = np.hstack([index.columns(literals, bindings), absent])
    conditions = tuple(
        _bind_condition(effect, compile_atoms, bindings, operator.arity, table)
        for effect in sorted(operator.conditional_effects)
    )
    return BoundOperator(table, which, true, false, added, deleted, conditions)


def _bindings(
    parameters: Sequence[Variable], arity: int, table: SkillTable
) -> tuple[NDArray[np.intp], Columns]:
    """Skill instance (bindings,) and distinct objects of the right types (bindings, positions)."""
    fits = [table.space.index.of_types(v.types) for v in parameters]
    fitting = np.ones(len(table.instances), dtype=bool)
    for place in range(arity):
        fitting &= fits[place][table.arguments[:, place]]
    instances = np.flatnonzero(fitting)
    contexts = list(itertools.product(*(np.flatnonzero(f) for f in fits[arity:])))
    context = np.array(contexts, dtype=np.intp).reshape(len(contexts), len(parameters) - arity)
    which = np.repeat(instances, len(contexts))
    bindings = np.hstack([table.arguments[which], np.tile(context, (len(instances), 1))])
    distinct = (np.diff(np.sort(bindings, axis=1), axis=1) != 0).all(axis=1)
    return which[distinct], bindings[distinct]


def _bind_condition(
    effect: ConditionalEffect,
    compile_atoms: Callable[[Iterable[Atom]], AtomPatterns],
    bindings: Columns,
    arity: int,
    table: SkillTable,
) -> BoundCondition:
    index = table.space.index

    def columns(atoms: Iterable[Atom]) -> Columns:
        return index.open_columns(compile_atoms(atoms), bindings).transpose(0, 2, 1)

    true = columns(x.atom for x in effect.condition if x.positive)
    false = columns(x.atom for x in effect.condition if not x.positive)
    changed = columns([effect.effect.atom])[:, :, 0]
    ranges = ~taken_objects(bindings[:, :arity], len(table.space.objects))
    ranges &= index.of_types(effect.quantified.types) & (true >= 0).all(axis=2)
    sign = 1 if effect.effect.positive else -1
    return BoundCondition(true, false, np.where(ranges, changed, -1), sign)


def _blocks(size: int) -> Iterator[slice]:
    for start in range(0, size, _BLOCK):
        yield slice(start, start + _BLOCK)

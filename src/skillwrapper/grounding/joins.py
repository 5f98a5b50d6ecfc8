"""Finding the bindings of an operator in abstract states, by joining on its conditions.

A parameter that is no argument of the skill is never bound to all objects in all combinations: one
after the other is bound, the one that the conditions tie most closely to those before it, and what
is unmet is dropped at once (D23 in docs/semantics.md). All attempts are joined together, in blocks
that bound the memory whatever the number of parameters, objects and states is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.atom_index import AtomPatterns, Columns, taken_objects
from skillwrapper.grounding.atom_space import FALSE, UNKNOWN
from skillwrapper.grounding.bindings import Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator, absent
from skillwrapper.symbols import Atom

BLOCK = 1 << 20
"""At most so many labels are looked up at once."""


def find_bindings(
    operator: IndexedOperator, attempts: Attempts, *, most_unmet: int = 0
) -> Iterator[Bindings]:
    """Bindings to distinct objects of the right types, block by block in the order of attempts.

    Only those that may apply, or of which at most ``most_unmet`` conditions are surely unmet.
    """
    join = _Join(operator, attempts, most_unmet)
    for start in range(0, len(attempts), join.block):
        stop = min(start + join.block, len(attempts))
        waiting = [(0, join.bind_arguments(np.arange(start, stop)))]
        while waiting:
            done, found = waiting.pop()
            if done == len(join.steps):
                found = join.check_absences(found)
                if len(found):
                    yield found
            else:
                parts = _split(join.bind_next(found, join.steps[done]), join.block)
                waiting += [(done + 1, part) for part in reversed(parts)]


@dataclass(frozen=True)
class _Step:
    """The next parameter to bind, with what can then be looked at.

    Attributes:
        bound: the positions that are bound before.
        position: of the parameter; of no meaning for what is bound beforehand.
        literals: the literals, by number, all of whose parameters are then bound.
        patterns: of these literals.
        changed: of the effects all of whose parameters are then bound.
    """

    bound: list[int]
    position: int
    literals: list[int]
    patterns: AtomPatterns
    changed: AtomPatterns


class _Join:
    """Joins the attempts at an operator with the objects that its parameters may stand for."""

    def __init__(self, operator: IndexedOperator, attempts: Attempts, most_unmet: int) -> None:
        self._operator, self._attempts, self._most = operator, attempts, most_unmet
        self._index = operator.space.index
        self._given = attempts.arguments.shape[1]
        self._size = len(operator.operator.parameters)
        given, order = list(range(self._given)), _order(operator, self._given)
        self._first = self._step([], given, first=True)
        self.steps = tuple(
            self._step([*given, *order[:number]], [position])
            for number, position in enumerate(order)
        )
        literals = max(len(step.literals) for step in (self._first, *self.steps))
        objects, atoms = len(operator.space.objects), len(operator.space.atoms)
        self.block = max(1, BLOCK // max(1, objects * (1 + literals), atoms))

    def bind_arguments(self, attempt: NDArray[np.intp]) -> Bindings:
        """Bindings of the arguments alone, one an attempt."""
        possible, columns, unfit = self._arguments
        which = self._attempts.which[attempt]
        attempt, which = attempt[possible[which]], which[possible[which]]
        objects = np.zeros((len(attempt), self._size), dtype=np.intp)
        objects[:, : self._given] = self._attempts.arguments[which]
        sure = np.zeros(len(attempt), dtype=bool)
        found = Bindings(self._operator, self._attempts, attempt, objects, unfit[which], sure)
        return self._check_literals(found, self._first, columns[which])

    @cached_property
    def _arguments(self) -> tuple[NDArray[np.bool_], Columns, NDArray[np.intp]]:
        """Of every skill instance: whether it fits, its literals' columns, doubtful types unmet."""
        objects = np.zeros((len(self._attempts.arguments), self._size), dtype=np.intp)
        objects[:, : self._given] = arguments = self._attempts.arguments
        places = np.arange(self._given)
        possible = self._operator.allowed[places, arguments].all(axis=1)
        possible &= (np.diff(np.sort(arguments, axis=1), axis=1) != 0).all(axis=1)
        possible &= (self._index.columns(self._first.changed, objects) >= 0).all(axis=1)
        unfit = (~self._operator.fits[places, arguments]).sum(axis=1)
        return possible, self._index.columns(self._first.patterns, objects), unfit

    def bind_next(self, found: Bindings, step: _Step) -> Bindings:
        """Bind one more parameter to every object that it may stand for."""
        position, operator = step.position, self._operator
        free = ~taken_objects(found.objects[:, step.bound], len(operator.space.objects))
        binding, other = np.nonzero(free & operator.allowed[position])
        objects = found.objects[binding]
        objects[:, position] = other
        unmet = found.unmet[binding] + ~operator.fits[position, other]
        unsure = found.unsure[binding]
        wider = Bindings(operator, self._attempts, found.attempt[binding], objects, unmet, unsure)
        wider = wider.select(np.all(self._index.columns(step.changed, objects) >= 0, axis=1))
        return self._check_literals(wider, step, self._index.columns(step.patterns, wider.objects))

    def _check_literals(self, found: Bindings, step: _Step, columns: Columns) -> Bindings:
        values = self._attempts.states.at(found.rows, columns)
        unknown = values == UNKNOWN
        unmet = (~unknown & (values != self._operator.wanted[step.literals])).sum(axis=1)
        return self._kept(found, unmet, unknown.any(axis=1))

    def check_absences(self, found: Bindings) -> Bindings:
        """Those of which no absence is unmet either; an absence speaks of all parameters."""
        for absence in sorted(self._operator.operator.absences):
            columns = self._operator.absent_columns(absence, found.objects)
            verdict = absent(self._attempts.states.at(found.rows, columns))
            found = self._kept(found, (verdict == FALSE).astype(np.intp), verdict == UNKNOWN)
        return found

    def _kept(
        self, found: Bindings, unmet: NDArray[np.intp], unsure: NDArray[np.bool_]
    ) -> Bindings:
        total = found.unmet + unmet
        noted = replace(found, unmet=total, unsure=found.unsure | unsure)
        return noted.select(total <= self._most)

    def _step(self, bound: list[int], new: list[int], *, first: bool = False) -> _Step:
        """What can be looked at when some parameters are newly bound; nullary atoms at first."""
        operator = self._operator.operator
        names = {operator.parameters[n].name for n in (*bound, *new)}
        fresh = {operator.parameters[n].name for n in new}

        def is_due(atom: Atom) -> bool:
            return names.issuperset(atom.terms) and (first or bool(fresh & {*atom.terms}))

        literals = [n for n, x in enumerate(self._operator.literals) if is_due(x.atom)]
        effects = sorted(operator.add_effects | operator.delete_effects)
        return _Step(
            bound,
            new[0] if new else 0,
            literals,
            self._operator.patterns(self._operator.literals[n].atom for n in literals),
            self._operator.patterns(atom for atom in effects if is_due(atom)),
        )


def _order(operator: IndexedOperator, given: int) -> list[int]:
    """The order in which the parameters behind the given ones are bound."""
    names = [v.name for v in operator.operator.parameters]
    bound, left = set(names[:given]), list(range(given, len(names)))
    positive = [set(x.atom.terms) for x in operator.literals if x.positive]
    order: list[int] = []

    def ties(position: int) -> tuple[int, int, int]:
        name = names[position]
        own = [terms for terms in positive if name in terms and terms <= {*bound, name}]
        return -sum(len(t) > 1 for t in own), -len(own), int(operator.allowed[position].sum())

    while left:
        position = min(left, key=ties)
        left.remove(position)
        order.append(position)
        bound.add(names[position])
    return order


def _split(found: Bindings, size: int) -> list[Bindings]:
    if len(found) <= size:
        return [found]
    return [found.select(slice(start, start + size)) for start in range(0, len(found), size)]

"""Finding the bindings of an operator in abstract states, by joining on its conditions.

A parameter that is no argument of the skill is never bound to all objects in all combinations: one
after the other is bound, the one that the conditions tie most closely to those before it, and what
is unmet is dropped at once (D23 in docs/semantics.md). All attempts are joined together, in blocks
that bound the memory whatever the number of parameters, objects and states is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.atom_index import Columns, taken_objects
from skillwrapper.grounding.atom_space import FALSE, UNKNOWN
from skillwrapper.grounding.bindings import Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator, absent
from skillwrapper.grounding.join_plans import JoinPlan, JoinStep

BLOCK = 1 << 20
"""At most so many labels are looked up at once."""

_FEW = 256
"""Parts of fewer bindings are not worth the trouble."""

Wanted = Callable[[Bindings], NDArray[np.bool_]]
"""Which of some bindings (bindings,), not all of whose parameters are bound yet, to go on with."""


def find_bindings(
    operator: IndexedOperator,
    attempts: Attempts,
    *,
    most_unmet: int = 0,
    wanted: Wanted | None = None,
) -> Iterator[Bindings]:
    """Bindings to distinct objects of the right types, block by block.

    Only those that may apply, or of which at most ``most_unmet`` conditions are surely unmet.

    Args:
        operator: the operator.
        attempts: skill instances in abstract states; blocks are in their order.
        most_unmet: so many conditions may be unmet.
        wanted: asked again and again, so that its answer may follow from what was found; blocks
            are then in an order that soon brings some binding of every attempt.
    """
    join = _Join(operator, attempts, most_unmet)
    for start in range(0, len(attempts), join.block):
        stop = min(start + join.block, len(attempts))
        waiting = [(0, join.bind_arguments(np.arange(start, stop)))]
        while waiting:
            done, found = waiting.pop()
            if wanted is not None:
                found = found.select(wanted(found))
            if done == len(join.steps):
                found = join.check_absences(found)
                if len(found):
                    yield found
            elif len(found):
                found, size = join.bind_next(found, join.steps[done]), join.block
                if wanted is not None and done + 1 < len(join.steps):
                    order, size = _by_turns(found.attempt, size)
                    found = found.select(order)
                waiting += [(done + 1, part) for part in reversed(_parts(found, size))]


class _Join:
    """Joins attempts at an operator with the objects that its parameters may stand for."""

    def __init__(self, operator: IndexedOperator, attempts: Attempts, most_unmet: int) -> None:
        self._operator, self._attempts, self._most = operator, attempts, most_unmet
        self._index = operator.space.index
        self._given = attempts.arguments.shape[1]
        plan = JoinPlan.of(operator, self._given, by_change=attempts.changes is not None)
        self._first, self.steps = plan.first, plan.steps
        objects, atoms = len(operator.space.objects), len(operator.space.atoms)
        self.block = max(1, BLOCK // max(1, objects * (1 + plan.widest), atoms))

    def bind_arguments(self, attempt: NDArray[np.intp]) -> Bindings:
        """Bindings of what is bound beforehand, one an attempt."""
        attempts, places = self._attempts, np.arange(self._given)
        objects = np.zeros((len(attempts.arguments), len(self._operator.fits)), dtype=np.intp)
        objects[:, : self._given] = arguments = attempts.arguments
        possible = self._operator.allowed[places, arguments].all(axis=1)
        possible &= (np.diff(np.sort(arguments, axis=1), axis=1) != 0).all(axis=1)
        unfit = (~self._operator.fits[places, arguments]).sum(axis=1)
        changed = self._index.columns(self._first.changed, objects)
        columns = self._index.columns(self._first.patterns, objects)
        attempt = attempt[possible[attempts.which[attempt]]]
        which, unsure = attempts.which[attempt], np.zeros(len(attempt), dtype=bool)
        found = Bindings(self._operator, attempts, attempt, objects[which], unfit[which], unsure)
        return self._check(found, self._first, changed[which], columns[which])

    def bind_next(self, found: Bindings, step: JoinStep) -> Bindings:
        """Bind one more parameter to every object that it may stand for."""
        position, operator = step.position, self._operator
        free = ~taken_objects(found.objects[:, step.bound], len(operator.space.objects))
        binding, other = np.nonzero(free & operator.allowed[position])
        objects = found.objects[binding]
        objects[:, position] = other
        unmet = found.unmet[binding] + ~operator.fits[position, other]
        unsure = found.unsure[binding]
        wider = Bindings(operator, self._attempts, found.attempt[binding], objects, unmet, unsure)
        changed = self._index.columns(step.changed, objects)
        return self._check(wider, step, changed, self._index.columns(step.patterns, objects))

    def check_absences(self, found: Bindings) -> Bindings:
        """Those of which no absence is unmet either; an absence speaks of all parameters."""
        for absence in sorted(self._operator.operator.absences):
            columns = self._operator.absent_columns(absence, found.objects)
            verdict = absent(self._attempts.states.at(found.rows, columns))
            found = self._kept(found, (verdict == FALSE).astype(np.intp), verdict == UNKNOWN)
        return found

    def _check(
        self, found: Bindings, step: JoinStep, changed: Columns, columns: Columns
    ) -> Bindings:
        """Those whose changed atoms are groundings, and changed so, and whose literals may hold."""
        possible = changed >= 0
        if self._attempts.changes is not None:
            became = self._attempts.changes.at(found.rows, changed)
            possible &= (became == step.becomes) | (became == UNKNOWN)
        if not possible.all():
            kept = np.all(possible, axis=1)
            found, columns = found.select(kept), columns[kept]
        values = self._attempts.states.at(found.rows, columns)
        unknown = values == UNKNOWN
        unmet = (~unknown & (values != step.wanted)).sum(axis=1)
        return self._kept(found, unmet, unknown.any(axis=1))

    def _kept(
        self, found: Bindings, unmet: NDArray[np.intp], unsure: NDArray[np.bool_]
    ) -> Bindings:
        total = found.unmet + unmet
        noted = replace(found, unmet=total, unsure=found.unsure | unsure)
        return noted.select(total <= self._most)


def _parts(found: Bindings, size: int) -> list[Bindings]:
    if len(found) <= size:
        return [found]
    return [found.select(slice(start, start + size)) for start in range(0, len(found), size)]


def _by_turns(attempt: NDArray[np.intp], most: int) -> tuple[NDArray[np.intp], int]:
    """An order in which the first of every attempt comes before the second of any.

    Returns:
        The order, and the size of parts of which the first one holds all the first ones.
    """
    order = np.argsort(attempt, kind="stable")
    own = attempt[order]
    turn = np.arange(len(own)) - np.searchsorted(own, own)
    first = int(np.count_nonzero(turn == 0))
    return order[np.argsort(turn, kind="stable")], min(most, max(first, _FEW))

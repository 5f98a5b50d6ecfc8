"""What the learned operators of a skill say of its own transitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, Labels
from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.bindings import UNCHANGED, Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.symbols import Operator
from skillwrapper.transitions.tables import SkillData, SkillTable


def attempts_of(table: SkillTable, rows: NDArray[np.intp] | None = None) -> Attempts:
    """The transitions of a table, or some rows of it, as attempts in the states before."""
    rows = np.arange(len(table)) if rows is None else rows
    return Attempts(AbstractStates(table.before), table.arguments, rows, table.which[rows])


@dataclass(frozen=True, eq=False)
class Application:
    """An operator applied to the transitions of a table, in every binding that may apply.

    Attributes:
        operator: the operator.
        table: the transitions.
        attempts: the same, as attempts.
        possible: rows, sorted, for which some binding may apply.
        sure: rows, sorted, for which some binding surely applies.
        mispredicted: rows, sorted, of successes for which one of these predicts another change;
            unknown and unexplained atoms do not count.
    """

    operator: Operator
    table: SkillTable
    attempts: Attempts
    possible: NDArray[np.intp]
    sure: NDArray[np.intp]
    mispredicted: NDArray[np.intp]

    @classmethod
    def of(cls, operator: Operator, table: SkillTable, attempts: Attempts) -> Application:
        """Apply an operator to a table, whose transitions are the attempts."""
        possible, sure, mispredicted = (np.zeros(len(table), dtype=bool) for _ in range(3))
        counts = table.success & ~table.hanging
        excused = table.undetermined | table.unexplained

        def wanted(bindings: Bindings) -> NDArray[np.bool_]:
            """Whether a binding may tell anything new of its row."""
            rows = bindings.rows
            surely = ~bindings.unsure & (~sure | (counts & ~mispredicted))[rows]
            tells: NDArray[np.bool_] = ~possible[rows] | surely
            return tells

        indexed = IndexedOperator(operator, table.space)
        for bindings in find_bindings(indexed, attempts, wanted=wanted):
            possible[bindings.rows] = True
            sure[bindings.sure.rows] = True
            found = bindings.sure.select(counts[bindings.sure.rows])
            wrong = (found.successors() != table.after[found.rows]) & ~excused[found.rows]
            mispredicted[found.rows[wrong.any(axis=1)]] = True
        return cls(operator, table, attempts, *map(np.flatnonzero, (possible, sure, mispredicted)))

    @cached_property
    def accounted(self) -> NDArray[np.intp]:
        """Rows, sorted, for which a binding surely applies and makes the whole known change."""
        return self._making_the_change(self.operator, surely=True)

    @cached_property
    def similar(self) -> NDArray[np.intp]:
        """Rows, sorted, whose whole known change some binding would make, applicable or not."""
        return self._making_the_change(_unconditional(self.operator), surely=False)

    def _making_the_change(self, operator: Operator, *, surely: bool) -> NDArray[np.intp]:
        table, attempts = self.table, replace(self.attempts, changes=_changes(self.table))
        making = np.zeros(len(table), dtype=bool)

        def wanted(bindings: Bindings) -> NDArray[np.bool_]:
            return ~making[bindings.rows] & ~(bindings.unsure & surely)

        indexed = IndexedOperator(operator, table.space)
        for bindings in find_bindings(indexed, attempts, wanted=wanted):
            found = bindings.sure if surely else bindings
            rows = found.rows
            wrong = (found.effects() != table.change[rows]) & ~table.undetermined[rows]
            making[rows[~wrong.any(axis=1)]] = True
        return np.flatnonzero(making)


def _changes(table: SkillTable) -> AbstractStates:
    became = np.select([table.change > 0, table.change < 0], [TRUE, FALSE], UNCHANGED)
    return AbstractStates(np.where(table.undetermined, UNKNOWN, became).astype(np.int8))


def _unconditional(operator: Operator) -> Operator:
    """An operator that makes the same changes whenever, without what only conditions speak of."""
    ranging = [x for e in operator.conditional_effects for x in (e.effect, *e.condition)]
    atoms = {*operator.add_effects, *operator.delete_effects, *(x.atom for x in ranging)}
    used = {term for atom in atoms for term in atom.terms}
    return replace(
        operator,
        parameters=(
            *operator.parameters[: operator.arity],
            *(v for v in operator.context if v.name in used),
        ),
        preconditions=frozenset(),
        absences=frozenset(),
    )


@dataclass(frozen=True, eq=False)
class TablePrediction:
    """What the operators of a skill say of one table of its transitions.

    Attributes:
        table: the transitions.
        operators: the operators.
        applications: one for every operator, in their order.
    """

    table: SkillTable
    operators: tuple[LearnedOperator, ...]
    applications: tuple[Application, ...]

    @cached_property
    def executable(self) -> Labels:
        """Whether some operator applies (n,): TRUE, FALSE or UNKNOWN."""
        verdict = np.full(len(self.table), FALSE, dtype=np.int8)
        for found in self.applications:
            verdict[found.possible] = UNKNOWN
        for found in self.applications:
            verdict[found.sure] = TRUE
        return verdict

    @cached_property
    def undecided(self) -> NDArray[np.bool_]:
        """Whether the change or the prediction hangs on an unknown label (n,), see D10."""
        undecided: NDArray[np.bool_] = self.table.hanging | (self.executable == UNKNOWN)
        return undecided

    @cached_property
    def accounted(self) -> NDArray[np.bool_]:
        """Whether some operator surely applies and makes the whole known change (n,)."""
        accounted = np.zeros(len(self.table), dtype=bool)
        for found in self.applications:
            accounted[found.accounted] = True
        return accounted

    @cached_property
    def mistaken(self) -> NDArray[np.bool_]:
        """Whether some operator that surely applies predicts another change (n,)."""
        mistaken = np.zeros(len(self.table), dtype=bool)
        for found in self.applications:
            mistaken[found.mispredicted] = True
        return mistaken

    @cached_property
    def disproved(self) -> NDArray[np.bool_]:
        """Whether some operator surely applies to a failure (n,)."""
        disproved: NDArray[np.bool_] = ~self.table.success & (self.executable == TRUE)
        return disproved

    @cached_property
    def wrong(self) -> NDArray[np.bool_]:
        """Whether a decided outcome or a change is predicted wrongly (n,)."""
        missed = self.table.success & ~self.accounted
        wrong: NDArray[np.bool_] = ((missed | self.disproved) & ~self.undecided) | self.mistaken
        return wrong


class Predictor:
    """Applies operators to the transitions of a skill, each operator only once.

    Args:
        data: the transitions.
    """

    def __init__(self, data: SkillData) -> None:
        self._data = data
        self._attempts = [attempts_of(table) for table in data]
        self._known: dict[LearnedOperator, tuple[Application, ...]] = {}

    def predict(self, operators: Sequence[LearnedOperator]) -> tuple[TablePrediction, ...]:
        """What several operators say of the transitions, table by table."""
        applied = [self._apply(learned) for learned in operators]
        return tuple(
            TablePrediction(table, tuple(operators), tuple(own[number] for own in applied))
            for number, table in enumerate(self._data)
        )

    def rename(self, learned: LearnedOperator, name: str) -> LearnedOperator:
        """The operator under another name; what it predicts is the same."""
        renamed = LearnedOperator(learned.operator.renamed(name), learned.cluster)
        self._known[renamed] = self._apply(learned)
        return renamed

    def _apply(self, learned: LearnedOperator) -> tuple[Application, ...]:
        if learned not in self._known:
            self._known[learned] = tuple(
                Application.of(learned.operator, table, attempts)
                for table, attempts in zip(self._data, self._attempts, strict=True)
            )
        return self._known[learned]


def predict(data: SkillData, operators: Sequence[LearnedOperator]) -> tuple[TablePrediction, ...]:
    """Apply the operators of a skill to its transitions."""
    return Predictor(data).predict(operators)

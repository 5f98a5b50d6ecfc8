"""What the learned operators of a skill say of its own transitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, Labels
from skillwrapper.learning.binding import BoundOperator, bind_operator
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.transitions.tables import SkillData, SkillTable


@dataclass(frozen=True, eq=False)
class Application:
    """An operator applied to the transitions of a table, in every binding of its parameters.

    Attributes:
        bound: the operator's bindings.
        binding: the binding of every pair of a binding and a transition of its skill instance.
        rows: the row of every pair; a transition occurs as often as it has bindings.
        applicability: TRUE, FALSE or UNKNOWN for every pair.
    """

    bound: BoundOperator
    binding: NDArray[np.intp]
    rows: NDArray[np.intp]
    applicability: Labels

    @classmethod
    def of(cls, learned: LearnedOperator, table: SkillTable) -> Application:
        """Apply an operator to a table."""
        bound = bind_operator(learned.operator, table)
        binding, rows = bound.pairs()
        return cls(bound, binding, rows, bound.applicability(binding, rows))

    @cached_property
    def accounted(self) -> NDArray[np.intp]:
        """Rows, sorted, for which some binding surely applies and makes the whole known change."""
        pairs = np.flatnonzero(self.applicability == TRUE)
        same = self.bound.makes_change(self.binding[pairs], self.rows[pairs])
        return np.unique(self.rows[pairs[same]])

    @cached_property
    def similar(self) -> NDArray[np.intp]:
        """Rows, sorted, for which some binding would make the whole known change."""
        return np.unique(self.rows[self.bound.makes_change(self.binding, self.rows)])

    @cached_property
    def mispredicted(self) -> NDArray[np.intp]:
        """Rows, sorted, of successes where a binding surely applies but predicts another change.

        Unknown and unexplained atoms do not count.
        """
        table = self.bound.table
        counts = (table.success & ~table.hanging)[self.rows]
        pairs = np.flatnonzero(counts & (self.applicability == TRUE))
        binding, rows = self.binding[pairs], self.rows[pairs]
        excused = table.undetermined | table.unexplained
        return np.unique(rows[self.bound.mispredicts(binding, rows, excused)])


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
        for value in (UNKNOWN, TRUE):
            for found in self.applications:
                verdict[found.rows[found.applicability == value]] = value
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


class Predictor:
    """Applies operators to the transitions of a skill, each operator only once.

    Args:
        data: the transitions.
    """

    def __init__(self, data: SkillData) -> None:
        self._data = data
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
            self._known[learned] = tuple(Application.of(learned, table) for table in self._data)
        return self._known[learned]


def predict(data: SkillData, operators: Sequence[LearnedOperator]) -> tuple[TablePrediction, ...]:
    """Apply the operators of a skill to its transitions."""
    return Predictor(data).predict(operators)

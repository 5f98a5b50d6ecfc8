"""What the learned operators of a skill say of its own transitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.learning.clusters import Group, group_by_change, touches_unknown
from skillwrapper.learning.data import SkillData, SkillTable
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.symbols import FALSE, TRUE, UNKNOWN, GroundOperator, Labels, ground_operator


@dataclass(frozen=True, eq=False)
class Application:
    """A ground operator and the transitions of its skill instance.

    Attributes:
        learned: the operator with its cluster.
        ground: the ground operator.
        rows: rows of the transitions in the table.
        applicability: TRUE, FALSE or UNKNOWN for every one of the rows.
    """

    learned: LearnedOperator
    ground: GroundOperator
    rows: NDArray[np.intp]
    applicability: Labels


@dataclass(frozen=True, eq=False)
class TablePrediction:
    """What the operators of a skill say of one table of its transitions.

    Attributes:
        table: the transitions.
        applications: every ground operator of an instance that occurs.
    """

    table: SkillTable
    applications: tuple[Application, ...]

    @cached_property
    def executable(self) -> Labels:
        """Whether some operator applies (n,): TRUE, FALSE or UNKNOWN."""
        verdict = np.full(len(self.table), FALSE, dtype=np.int8)
        for found in self.applications:
            now = verdict[found.rows]
            unknown = (now == FALSE) & (found.applicability == UNKNOWN)
            now = np.where(found.applicability == TRUE, TRUE, np.where(unknown, UNKNOWN, now))
            verdict[found.rows] = now
        return verdict

    @cached_property
    def successes(self) -> tuple[Group, ...]:
        """The successes whose change is determined, by skill instance and change."""
        return tuple(group_by_change(self.table, self.table.success & ~self.undetermined))

    @cached_property
    def failures(self) -> tuple[Group, ...]:
        """The failures whose change is determined, by skill instance and change."""
        return tuple(group_by_change(self.table, ~self.table.success & ~self.undetermined))

    @cached_property
    def undetermined(self) -> NDArray[np.bool_]:
        """Whether the change around the arguments is not known (n,)."""
        return touches_unknown(self.table)

    @cached_property
    def undecided(self) -> NDArray[np.bool_]:
        """Whether the change or the prediction hangs on an unknown label (n,), see D10."""
        hanging: NDArray[np.bool_] = self.undetermined | (self.executable == UNKNOWN)
        return hanging

    @cached_property
    def accounted(self) -> NDArray[np.bool_]:
        """Whether some operator surely applies and makes the whole known change (n,)."""
        accounted = np.zeros(len(self.table), dtype=bool)
        for found in self.applications:
            accounted[found.rows] |= self.makes_change(found) & (found.applicability == TRUE)
        return accounted

    def makes_change(self, application: Application) -> NDArray[np.bool_]:
        """Whether the whole known change of the transitions is the operator's effect (rows,)."""
        rows = application.rows
        effect = application.ground.effects(self.table.before[rows])
        known = ~self.table.undetermined()[rows]
        same: NDArray[np.bool_] = (np.where(known, effect, 0) == self._change[rows]).all(axis=1)
        return same

    @cached_property
    def _change(self) -> Labels:
        return self.table.change()

    @cached_property
    def unexplained(self) -> NDArray[np.bool_]:
        """Changed atoms that are connected to no argument (n, atoms)."""
        mask = np.zeros(self.table.before.shape, dtype=bool)
        for group in (*self.successes, *self.failures):
            columns = self.table.space.columns(group.lifting.unexplained)
            mask[np.ix_(group.rows, columns)] = True
        return mask

    def mispredicted(self, application: Application) -> NDArray[np.intp]:
        """Rows of successes where the operator surely applies but predicts another change.

        Unknown and unexplained atoms do not count.
        """
        table = self.table
        rows = application.rows[application.applicability == TRUE]
        rows = rows[table.success[rows] & ~self.undetermined[rows]]
        predicted = application.ground.apply(table.before[rows])
        counts = ~table.undetermined()[rows] & ~self.unexplained[rows]
        wrong: NDArray[np.bool_] = ((predicted != table.after[rows]) & counts).any(axis=1)
        mistaken: NDArray[np.intp] = rows[wrong]
        return mistaken


def predict(data: SkillData, operators: Sequence[LearnedOperator]) -> tuple[TablePrediction, ...]:
    """Apply the operators of a skill to its transitions."""
    return tuple(TablePrediction(t, tuple(_applications(t, operators))) for t in data)


def _applications(table: SkillTable, operators: Sequence[LearnedOperator]) -> list[Application]:
    rows_of = {
        instance: np.flatnonzero(table.which == number)
        for number, instance in enumerate(table.instances)
    }
    found = []
    for learned in operators:
        for ground in ground_operator(learned.operator, table.space):
            rows = rows_of.get(ground.instance)
            if rows is not None and len(rows):
                applicability = ground.applicability(table.before[rows])
                found.append(Application(learned, ground, rows, applicability))
    return found

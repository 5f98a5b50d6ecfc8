"""Clusters: the successes of a skill that made the same lifted change (paper, Section 3.3)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import Labels
from skillwrapper.grounding.atom_index import Columns, taken_objects
from skillwrapper.transitions.lifting import LiftedChange
from skillwrapper.transitions.tables import Group, SkillData, SkillTable


@dataclass(frozen=True, eq=False)
class Cluster:
    """Groups with the same lifted change; one operator is learned from each cluster.

    Attributes:
        change: the lifted change they share.
        groups: the groups, in the order of the data.
    """

    change: LiftedChange
    groups: tuple[Group, ...]

    @property
    def context(self) -> int:
        """Number of objects in the change that are no arguments."""
        first = self.groups[0]
        return len(first.lifting.objects) - len(first.instance.arguments)

    @cached_property
    def ids(self) -> list[int]:
        """Numbers of the transitions, in order of time."""
        return sorted(int(i) for g in self.groups for i in g.table.ids[g.rows])


@dataclass(frozen=True, eq=False)
class Bundle:
    """Groups of one table whose lifted changes have the same number of objects.

    Attributes:
        table: where they stand.
        bindings: the numbers of the objects (groups, positions) of each group.
        rows: the rows of all their transitions (rows,).
        group: the group (rows,) of each of these.
    """

    table: SkillTable
    bindings: Columns
    rows: NDArray[np.intp]
    group: NDArray[np.intp]

    @property
    def first(self) -> NDArray[np.intp]:
        """The place (groups,) of each group's first transition among all."""
        return np.searchsorted(self.group, np.arange(len(self.bindings)))

    @property
    def taken(self) -> NDArray[np.bool_]:
        """Which objects of the scene (groups, objects) stand at a position."""
        return taken_objects(self.bindings, len(self.table.space.objects))

    def labels(self, columns: Columns) -> Labels:
        """Labels before (rows, ...) in columns (groups, ...); ``NO_LABEL`` for no column."""
        rows = self.rows.reshape(-1, *[1] * (columns.ndim - 1))
        labels: Labels = self.table.padded[rows, columns[self.group]]
        return labels


def bundle_groups(groups: Sequence[Group]) -> Iterator[Bundle]:
    """The groups of a cluster, table by table, to be looked at all at once."""
    by_table: dict[SkillTable, list[Group]] = {}
    for group in groups:
        by_table.setdefault(group.table, []).append(group)
    for table, own in by_table.items():
        index = table.space.index
        bindings = np.array([index.numbers(g.lifting.objects) for g in own], dtype=np.intp)
        sizes = [len(g.rows) for g in own]
        numbers = np.repeat(np.arange(len(own)), sizes)
        yield Bundle(table, bindings, np.concatenate([g.rows for g in own]), numbers)


def cluster_successes(data: SkillData) -> tuple[Cluster, ...]:
    """Cluster the successes of a skill by their lifted changes, sorted by change.

    A success of which the lifted change is not known founds no cluster (D10).
    """
    found: dict[LiftedChange, list[Group]] = {}
    for table in data:
        for group in table.successes:
            found.setdefault(group.lifting.change, []).append(group)
    return tuple(Cluster(change, tuple(found[change])) for change in sorted(found))

"""Successes that changed nothing (D7): no evidence that a change is not told."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.transitions.tables import Group, SkillTable

NoOps = dict[SkillTable, NDArray[np.bool_]]
"""For every table whether a transition (n,) is a success that changed nothing."""


def find_no_ops(tables: Iterable[SkillTable]) -> NoOps:
    """The successes of one skill that changed nothing.

    That is so if the state is known to be unchanged, and also if a success changed no label
    while others of the skill did. As long as none did, equal labels tell nothing: the predicate
    that would tell the change may be missing.
    """
    data = tuple(tables)
    moved = {table: table.success & table.change.any(axis=1) for table in data}
    still = {t: t.success & ~t.hanging & ~t.change.any(axis=1) for t in data}
    if any(rows.any() for rows in moved.values()):
        return {t: t.success & (t.unchanged | still[t]) for t in data}
    return {t: t.success & t.unchanged for t in data}


def rows_that_tell(prediction: TablePrediction, group: Group, no_ops: NoOps) -> NDArray[np.intp]:
    """The rows of a group that are evidence of its lifted change.

    Not those that changed nothing (D7), nor those that only changed what conditional effects
    account for (D5).
    """
    told = ~no_ops[prediction.table][group.rows]
    if group.lifting.unexplained and not group.lifting.change:
        told &= ~prediction.accounted[group.rows]
    return group.rows[told]


def is_no_op(cluster: Cluster, no_ops: NoOps) -> bool:
    """Whether none of the transitions of a cluster changed anything."""
    return all(bool(no_ops[g.table][g.rows].all()) for g in cluster.groups)

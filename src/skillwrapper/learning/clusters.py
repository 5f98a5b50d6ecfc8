"""Clusters: the successes of a skill that made the same lifted change (paper, Section 3.3)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.learning.data import SkillData, SkillTable
from skillwrapper.learning.lifting import LiftedChange, Lifting, lift_change
from skillwrapper.symbols import AtomSpace, Labels, Literal
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True, eq=False)
class Group:
    """Transitions of one skill instance that made the same ground change.

    Attributes:
        table: where they stand.
        rows: their rows in the table, in order of time.
        lifting: the change, lifted.
    """

    table: SkillTable
    rows: NDArray[np.intp]
    lifting: Lifting

    @property
    def before(self) -> Labels:
        """Labels before the execution (rows, atoms)."""
        return self.table.before[self.rows]

    @property
    def instance(self) -> SkillInstance:
        """The skill instance that they share."""
        return self.table.instances[int(self.table.which[self.rows[0]])]

    @property
    def types(self) -> tuple[tuple[str, ...], ...]:
        """The types of the objects at the positions of the lifted change."""
        types = _types(self.table.space)
        return tuple(types[name] for name in self.lifting.objects)


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
    def ids(self) -> list[int]:
        """Numbers of the transitions, in order of time."""
        return sorted(int(i) for g in self.groups for i in g.table.ids[g.rows])

    @property
    def is_no_op(self) -> bool:
        """Whether none of the transitions changed anything visible (DESIGN.md D7)."""
        return all(bool(g.table.unchanged[g.rows].all()) for g in self.groups)


def cluster_successes(data: SkillData) -> tuple[Cluster, ...]:
    """Cluster the successes of a skill by their lifted changes, sorted by change.

    A success of which the lifted change is not known founds no cluster (DESIGN.md D10).
    """
    found: dict[LiftedChange, list[Group]] = {}
    for table in data:
        for group in group_by_change(table, table.success & ~touches_unknown(table)):
            found.setdefault(group.lifting.change, []).append(group)
    return tuple(Cluster(change, tuple(found[change])) for change in sorted(found))


def group_by_change(table: SkillTable, mask: NDArray[np.bool_]) -> Iterator[Group]:
    """Group the masked transitions of a table by skill instance and ground change."""
    rows = np.flatnonzero(mask)
    if len(rows) == 0:
        return
    change = table.change()[rows]
    types = _types(table.space)
    for members in _equal_rows(table.which[rows], change):
        first = int(members[0])
        instance = table.instances[table.which[rows[first]]]
        literals = changed_literals(table.space, change[first])
        yield Group(table, rows[members], lift_change(literals, instance.arguments, types))


def changed_literals(space: AtomSpace, change: Labels) -> list[Literal]:
    """The literals that became true, from a signed change (atoms,)."""
    return [Literal(space.atoms[i], bool(change[i] > 0)) for i in np.flatnonzero(change)]


def touches_unknown(table: SkillTable) -> NDArray[np.bool_]:
    """Whether the lifted change of a transition (n,) is not known.

    That is so if an undetermined atom is nullary, or of an argument, or of an object that the
    known changes connect to an argument.
    """
    undetermined = table.undetermined()
    if not undetermined.any():
        return np.zeros(len(table), dtype=bool)
    terms = [frozenset(atom.terms) for atom in table.space.atoms]
    touched = _of_arguments(table, undetermined, terms)
    change = table.change()
    for row in np.flatnonzero(undetermined.any(axis=1) & ~touched):
        literals = changed_literals(table.space, change[row])
        lifting = lift_change(literals, table.instances[table.which[row]].arguments)
        touched[row] = any(
            terms[i].intersection(lifting.objects) for i in undetermined[row].nonzero()[0]
        )
    return touched


def _of_arguments(
    table: SkillTable, marked: NDArray[np.bool_], terms: Sequence[frozenset[str]]
) -> NDArray[np.bool_]:
    """Whether a marked atom (n, atoms) of a transition (n,) is nullary or of an argument."""
    found = np.zeros(len(table), dtype=bool)
    for number, instance in enumerate(table.instances):
        columns = [
            i for i, own in enumerate(terms) if not own or own.intersection(instance.arguments)
        ]
        mine = table.which == number
        found[mine] = marked[np.ix_(mine, columns)].any(axis=1)
    return found


def _types(space: AtomSpace) -> dict[str, tuple[str, ...]]:
    return {o.name: o.types for o in space.objects}


def _equal_rows(which: NDArray[np.intp], change: Labels) -> Iterator[NDArray[np.intp]]:
    """Index sets of rows that agree in both, in the order of their first occurrence."""
    packed = np.hstack(
        [
            which.astype(np.int32)[:, np.newaxis].view(np.uint8).reshape(len(which), -1),
            np.packbits(change > 0, axis=1),
            np.packbits(change < 0, axis=1),
        ]
    )
    keys = np.ascontiguousarray(packed).view(f"V{packed.shape[1]}").ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    order = np.argsort(inverse, kind="stable")
    bounds = np.searchsorted(inverse[order], np.arange(len(first) + 1))
    for number in np.argsort(first, kind="stable"):
        yield order[bounds[number] : bounds[number + 1]]

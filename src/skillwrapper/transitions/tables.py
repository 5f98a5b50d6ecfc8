"""What the learner learns from: transitions as arrays of labels, one table for each scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import UNKNOWN, AtomSpace, Labels
from skillwrapper.grounding.atom_index import Columns
from skillwrapper.symbols import Literal
from skillwrapper.transitions.lifting import Lifter, Lifting
from skillwrapper.world.skills import SkillInstance

NO_LABEL = 2
"""What a column beyond the last one holds: the label of an atom that is no grounding."""


@dataclass(frozen=True, eq=False)
class SkillTable:
    """The transitions of one skill in one scene; compared by identity.

    Attributes:
        space: the ground atoms over the scene's objects.
        instances: the skill instances that occur.
        which: for every transition (n,) the index into ``instances``.
        success: for every transition (n,) whether it succeeded.
        before: labels before (n, atoms).
        after: labels after (n, atoms).
        ids: for every transition (n,) its number in the whole data set, in order of time.
        unchanged: for every transition (n,) whether the state is known not to have changed,
            whatever its labels say.
        lifter: lifts changes; shared by tables, so that it remembers more.
    """

    space: AtomSpace
    instances: tuple[SkillInstance, ...]
    which: NDArray[np.intp]
    success: NDArray[np.bool_]
    before: Labels
    after: Labels
    ids: NDArray[np.intp]
    unchanged: NDArray[np.bool_]
    lifter: Lifter = field(default_factory=Lifter, repr=False)

    def __len__(self) -> int:
        return len(self.which)

    def select(self, mask: NDArray[np.bool_]) -> SkillTable:
        """The transitions for which the mask (n,) holds."""
        return SkillTable(
            self.space,
            self.instances,
            self.which[mask],
            self.success[mask],
            self.before[mask],
            self.after[mask],
            self.ids[mask],
            self.unchanged[mask],
            self.lifter,
        )

    @cached_property
    def change(self) -> Labels:
        """Signed change (n, atoms): 1 became true, -1 became false, 0 neither or not known."""
        return np.where(self.undetermined, 0, self.after - self.before).astype(np.int8)

    @cached_property
    def undetermined(self) -> NDArray[np.bool_]:
        """Whether an atom's change is not known (n, atoms)."""
        unknown: NDArray[np.bool_] = (self.before == UNKNOWN) | (self.after == UNKNOWN)
        return unknown

    @cached_property
    def hanging(self) -> NDArray[np.bool_]:
        """Whether the lifted change of a transition (n,) is not known.

        That is so if an undetermined atom is nullary, or of an argument, or of an object that
        the known changes connect to an argument.
        """
        if not self.undetermined.any():
            return np.zeros(len(self), dtype=bool)
        terms = [frozenset(atom.terms) for atom in self.space.atoms]
        hanging = self._of_arguments(self.undetermined, terms)
        for row in np.flatnonzero(self.undetermined.any(axis=1) & ~hanging):
            objects = self._lift(int(row)).objects
            unknown = self.undetermined[row].nonzero()[0]
            hanging[row] = any(terms[i].intersection(objects) for i in unknown)
        return hanging

    @cached_property
    def successes(self) -> tuple[Group, ...]:
        """The successes whose change is determined, by skill instance and change."""
        return self.group(self.success & ~self.hanging)

    @cached_property
    def failures(self) -> tuple[Group, ...]:
        """The failures whose change is determined, by skill instance and change."""
        return self.group(~self.success & ~self.hanging)

    @cached_property
    def unexplained(self) -> NDArray[np.bool_]:
        """Changed atoms that are connected to no argument (n, atoms)."""
        unexplained = np.zeros(self.before.shape, dtype=bool)
        for group in (*self.successes, *self.failures):
            if group.lifting.unexplained:
                columns = self.space.columns(group.lifting.unexplained)
                unexplained[np.ix_(group.rows, columns)] = True
        return unexplained

    def group(self, mask: NDArray[np.bool_]) -> tuple[Group, ...]:
        """Group the masked transitions by skill instance and ground change."""
        rows = np.flatnonzero(mask)
        members = _equal_rows(self.which[rows], self.change[rows])
        return tuple(Group(self, rows[own], self._lift(int(rows[own[0]]))) for own in members)

    @cached_property
    def padded(self) -> Labels:
        """Labels before, with one more column (n, atoms + 1) of what has no label."""
        return np.pad(self.before, ((0, 0), (0, 1)), constant_values=NO_LABEL)

    @cached_property
    def arguments(self) -> Columns:
        """The numbers of the objects (instances, arity) of every skill instance."""
        index = self.space.index
        return np.array([index.numbers(i.arguments) for i in self.instances], dtype=np.intp)

    @cached_property
    def types(self) -> dict[str, tuple[str, ...]]:
        """The types of every object."""
        return {o.name: o.types for o in self.space.objects}

    def argument_types(self, row: int) -> tuple[tuple[str, ...], ...]:
        """The types of the arguments of a transition."""
        return tuple(self.types[name] for name in self.instances[self.which[row]].arguments)

    def changed_literals(self, row: int) -> list[Literal]:
        """The literals that became true in a transition."""
        return changed_literals(self.space, self.change[row])

    def _lift(self, row: int) -> Lifting:
        arguments = self.instances[self.which[row]].arguments
        return self.lifter.lift(self.changed_literals(row), arguments, self.types)

    def _of_arguments(
        self, marked: NDArray[np.bool_], terms: Sequence[frozenset[str]]
    ) -> NDArray[np.bool_]:
        """Whether a marked atom (n, atoms) of a transition (n,) is nullary or of an argument."""
        found = np.zeros(len(self), dtype=bool)
        for number, instance in enumerate(self.instances):
            columns = [
                i for i, own in enumerate(terms) if not own or own.intersection(instance.arguments)
            ]
            mine = self.which == number
            found[mine] = marked[np.ix_(mine, columns)].any(axis=1)
        return found


SkillData = tuple[SkillTable, ...]
"""The transitions of one skill, one table a scene."""


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
    def instance(self) -> SkillInstance:
        """The skill instance that they share."""
        return self.table.instances[int(self.table.which[self.rows[0]])]

    @property
    def types(self) -> tuple[tuple[str, ...], ...]:
        """The types of the objects at the positions of the lifted change."""
        return tuple(self.table.types[name] for name in self.lifting.objects)

    @property
    def changed(self) -> list[Literal]:
        """The literals that became true in each of the transitions."""
        return self.table.changed_literals(int(self.rows[0]))


def changed_literals(space: AtomSpace, change: Labels) -> list[Literal]:
    """The literals that became true, from a signed change (atoms,)."""
    return [Literal(space.atoms[i], bool(change[i] > 0)) for i in np.flatnonzero(change)]


def _equal_rows(which: NDArray[np.intp], change: Labels) -> list[NDArray[np.intp]]:
    """Index sets of rows that agree in both, in the order of their first occurrence."""
    parts = (
        which.astype(np.int32)[:, np.newaxis].view(np.uint8).reshape(len(which), 4),
        np.packbits(change > 0, axis=1),
        np.packbits(change < 0, axis=1),
    )
    packed = np.hstack(parts)
    text, width = packed.tobytes(), packed.shape[1]
    members: dict[bytes, list[int]] = {}
    for row in range(len(which)):
        members.setdefault(text[row * width : (row + 1) * width], []).append(row)
    return [np.array(rows, dtype=np.intp) for rows in members.values()]

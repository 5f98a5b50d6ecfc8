"""What the learner learns from: transitions as arrays of labels, one table for each scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.symbols import UNKNOWN, AtomSpace, Labels
from skillwrapper.world.skills import SkillInstance


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
        unchanged: for every transition (n,) whether its two observations are identical.
    """

    space: AtomSpace
    instances: tuple[SkillInstance, ...]
    which: NDArray[np.intp]
    success: NDArray[np.bool_]
    before: Labels
    after: Labels
    ids: NDArray[np.intp]
    unchanged: NDArray[np.bool_]

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
        )

    def change(self) -> Labels:
        """Signed change (n, atoms): 1 became true, -1 became false, 0 neither or not known."""
        known = (self.before != UNKNOWN) & (self.after != UNKNOWN)
        return np.where(known, self.after - self.before, 0).astype(np.int8)

    def undetermined(self) -> NDArray[np.bool_]:
        """Whether an atom's change is not known (n, atoms)."""
        unknown: NDArray[np.bool_] = (self.before == UNKNOWN) | (self.after == UNKNOWN)
        return unknown


SkillData = tuple[SkillTable, ...]
"""The transitions of one skill, one table a scene."""

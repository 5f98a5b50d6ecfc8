"""Executions: which skills were run in a scene and what came of them, as arrays without labels."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True, eq=False)
class Executions:
    """Skill instances that were run in one scene; compared by identity.

    Attributes:
        scene: the objects that were present.
        instances: the skill instances that occur.
        which: for every execution (n,) the index into ``instances``.
        success: for every execution (n,) whether it succeeded.
        before: for every execution (n,) the number of the state before, among the scene's states.
        after: for every execution (n,) the number of the state after; that before if it is known
            to be the same.
        unchanged: for every execution (n,) whether the state is known not to have changed,
            whatever its labels say: the domain or the robot says so (D11, D17).
        ids: for every execution (n,) its number among all transitions, in order of time.
    """

    scene: Scene
    instances: tuple[SkillInstance, ...]
    which: NDArray[np.intp]
    success: NDArray[np.bool_]
    before: NDArray[np.intp]
    after: NDArray[np.intp]
    unchanged: NDArray[np.bool_]
    ids: NDArray[np.intp]
    _of_skill: dict[str, Executions] = field(default_factory=dict, repr=False)

    def __len__(self) -> int:
        return len(self.which)

    @property
    def skills(self) -> frozenset[str]:
        """Names of the skills that were run."""
        return frozenset(instance.skill for instance in self.instances)

    def of_skill(self, name: str) -> Executions:
        """Those of one skill, their instances sorted."""
        if name not in self._of_skill:
            instances = tuple(sorted(i for i in self.instances if i.skill == name))
            number = {instance: place for place, instance in enumerate(instances)}
            renumbered = np.array([number.get(i, -1) for i in self.instances], dtype=np.intp)
            which = renumbered[self.which] if len(self) else self.which
            mine = which >= 0
            self._of_skill[name] = Executions(
                self.scene,
                instances,
                which[mine],
                self.success[mine],
                self.before[mine],
                self.after[mine],
                self.unchanged[mine],
                self.ids[mine],
            )
        return self._of_skill[name]

    @cached_property
    def states(self) -> NDArray[np.intp]:
        """The states before, then the states after (2n,)."""
        return np.concatenate([self.before, self.after])

    @cached_property
    def digest(self) -> bytes:
        """Of all that is not labels: equal if the same was run with the same outcome."""
        named = repr((self.scene.name, [(o.name, o.types) for o in self.scene.objects]))
        digest = hashlib.blake2b(f"{named}{self.instances}".encode(), digest_size=16)
        for array in (self.which, self.success, self.unchanged, self.ids):
            digest.update(array.tobytes())
        return digest.digest()

"""Whether arms, and what they hold, touch anything that they must not touch."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, Final

import numpy as np

from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.kinematics import Joints
from skillwrapper.domains.tabletop.world import TableWorld

_TOLERANCE: Final = 0.002
"""Things that rest on each other overlap a little; so much is no collision, in metres."""


class Clearance:
    """Tells what an arm would touch, on data of its own.

    Args:
        world: of which the present state is copied whenever it is asked for.
    """

    def __init__(self, world: TableWorld) -> None:
        self._world, model = world, world.model
        self._data = mujoco().MjData(model)
        names = [self._owner(int(body)) for body in model.geom_bodyid]
        self._owners = np.array(names, object)

    def renew(self) -> None:
        """Look at the world as it is now."""
        data, present = self._data, self._world.data
        data.qpos[:] = present.qpos
        data.mocap_pos[:], data.mocap_quat[:] = present.mocap_pos, present.mocap_quat

    def data_with(self, arm: str, joints: Joints) -> Any:
        """The data as it would be with an arm's joints so; until the next call."""
        self._data.qpos[self._world.arms[arm].addresses] = joints
        mujoco().mj_kinematics(self._world.model, self._data)
        self._world.carry(arm, self._data)
        return self._data

    def touched(self, arm: str, joints: Joints, allowed: Collection[str] = ()) -> str | None:
        """What an arm would touch with its joints so; None if nothing.

        Args:
            arm: its name.
            joints: of it (joints,).
            allowed: names of what may be touched; ``"table"`` is one.

        Returns:
            ``"table"``, or the name of a thing or arm.
        """
        world = self._world
        self.data_with(arm, joints)
        mujoco().mj_collision(world.model, self._data)
        own = {arm, *world.carried(arm)}
        contact = self._data.contact
        for geoms in contact.geom[contact.dist < -_TOLERANCE]:
            first, second = (self._owners[g] for g in geoms)
            if (first in own) != (second in own):
                other = second if first in own else first
                if other not in allowed:
                    return str(other)
        return None

    def _owner(self, body: int) -> str:
        """The arm or thing that a body belongs to; the table for all that stands still."""
        model: Any = self._world.model
        name = model.body(model.body_rootid[body]).name
        if name == "world":
            return "table"
        for arm in self._world.arms:
            if name.startswith(f"{arm}_"):
                # What stands still touches the table it is screwed to.
                return "table" if model.body_weldid[body] == 0 else arm
        return str(name)

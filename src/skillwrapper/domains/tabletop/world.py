"""The world of a table: where things are, who holds what, and what is shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from skillwrapper.domains.tabletop.arms import ArmKind
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.kinematics import Arm, Joints
from skillwrapper.domains.tabletop.poses import Pose
from skillwrapper.domains.tabletop.stage import PARKING_HEIGHT
from skillwrapper.domains.tabletop.welds import fasten, loosen


@dataclass(frozen=True)
class ArmSetup:
    """An arm of a world.

    Attributes:
        name: as given to ``add_arm``.
        kind: of arm.
        home: joints where it waits (joints,).
    """

    name: str
    kind: ArmKind
    home: tuple[float, ...]


@dataclass(frozen=True)
class Held:
    """A thing in a gripper.

    Attributes:
        thing: its name.
        pose: of the thing as the grip sees it.
    """

    thing: str
    pose: Pose


class TableWorld:
    """A compiled stage with its arms and things.

    Args:
        model: compiled.
        arms: what stands on the stage.

    Attributes:
        model: compiled.
        data: its present state.
        arms: by name.
        held: what each arm holds; arms that hold nothing are missing.
        attached: what sticks to another thing until an arm takes it off: the other, and its pose.
        home: joints of each arm where it waits.
    """

    def __init__(self, model: Any, arms: Sequence[ArmSetup]) -> None:
        self.model, self.data = model, mujoco().MjData(model)
        self.arms: Mapping[str, Arm] = {a.name: Arm(model, a.name, a.kind, a.home) for a in arms}
        self.home: dict[str, Joints] = {a.name: np.array(a.home, float) for a in arms}
        self.held: dict[str, Held] = {}
        self.attached: dict[str, Held] = {}
        self._shown_alpha = model.geom_rgba[:, 3].copy()
        self.clear()

    def clear(self) -> None:
        """All things away, all arms at home with open and empty hands."""
        mujoco().mj_resetData(self.model, self.data)
        self.held.clear()
        self.attached.clear()
        for name, arm in self.arms.items():
            self.data.qpos[arm.addresses] = self.home[name]
            self.data.ctrl[arm.servos] = self.home[name]
            self.set_fingers(name, arm.kind.opened)
        self.refresh()

    def refresh(self) -> None:
        """Let poses follow from joints."""
        mujoco().mj_kinematics(self.model, self.data)

    def joints(self, arm: str) -> Joints:
        """Present joints of an arm (joints,)."""
        found: Joints = self.data.qpos[self.arms[arm].addresses].copy()
        return found

    def set_joints(self, arm: str, joints: ArrayLike) -> None:
        """Put an arm, and what it holds, where its joints say."""
        self.data.qpos[self.arms[arm].addresses] = joints
        self.refresh()
        self.carry(arm, self.data)

    def set_fingers(self, arm: str, opening: float) -> None:
        """Open a gripper so far, at once."""
        self.data.qpos[self.arms[arm].fingers] = self.arms[arm].finger_values(opening)

    def carry(self, arm: str, data: Any) -> None:
        """In some data, put what an arm holds where its gripper is."""
        held = self.held.get(arm)
        if held is not None:
            self._put(data, held.thing, self.arms[arm].grip(data) @ held.pose)
            mujoco().mj_kinematics(self.model, data)
            self._carry_attached(held.thing, data)

    def carried(self, arm: str) -> frozenset[str]:
        """What moves with an arm: what it holds, and what is attached to that."""
        held = self.held.get(arm)
        if held is None:
            return frozenset()
        on_it = (thing for thing, at in self.attached.items() if at.thing == held.thing)
        return frozenset((held.thing, *on_it))

    def give(self, arm: str, thing: str, grip: Pose, opening: float) -> None:
        """Put a thing into a gripper, as if it had been taken where it is.

        Args:
            arm: its name.
            thing: that is in the scene.
            grip: where the gripper would have taken it.
            opening: of the fingers.
        """
        self.held[arm] = Held(thing, grip.inverse() @ self.pose(thing))
        self.detach(thing)
        self.set_fingers(arm, opening)
        self.refresh()
        self.carry(arm, self.data)

    def attach(self, thing: str, to: str, pose: Pose) -> None:
        """Let a thing stick to another one, in a pose as the other sees it.

        Args:
            thing: its name.
            to: what it sticks to; the stage has a weld for the two.
            pose: of the thing.
        """
        self.attached[thing] = Held(to, pose)
        self._carry_attached(to, self.data)
        fasten(self.model, self.data, to, thing)

    def detach(self, thing: str) -> None:
        """Let a thing stick to nothing."""
        at = self.attached.pop(thing, None)
        if at is not None:
            loosen(self.model, self.data, at.thing, thing)

    def home_grip(self, arm: str) -> Pose:
        """Where the grip is when an arm waits."""
        return self.arms[arm].grip_at(self.home[arm])

    def pose(self, thing: str) -> Pose:
        """Where a thing is."""
        body = self.model.body(thing).id
        return Pose.of(self.data.xpos[body], self.data.xmat[body])

    def put(self, thing: str, pose: Pose) -> None:
        """Put a thing somewhere, at rest; arms do not move."""
        self.model.body_gravcomp[self.model.body(thing).id] = 0
        self._put(self.data, thing, pose)
        self.refresh()

    def put_away(self, thing: str) -> None:
        """Take a thing out of the scene."""
        self.put(thing, Pose.at(0.0, 0.0, PARKING_HEIGHT))
        self.model.body_gravcomp[self.model.body(thing).id] = 1  # lest it fall back

    def is_away(self, thing: str) -> bool:
        """Whether a thing is not in the scene."""
        return bool(self.pose(thing).position[2] > PARKING_HEIGHT / 2)

    def grip(self, arm: str) -> Pose:
        """Where the point between an arm's fingers is."""
        return self.arms[arm].grip(self.data)

    def holder(self, thing: str) -> str | None:
        """The arm that holds a thing; None if none does."""
        return next((arm for arm, held in self.held.items() if held.thing == thing), None)

    def show(self, prefix: str, visible: bool) -> None:
        """Show or hide all geoms whose names begin so."""
        for geom in range(self.model.ngeom):
            if self.model.geom(geom).name.startswith(prefix):
                self.model.geom_rgba[geom, 3] = self._shown_alpha[geom] if visible else 0.0

    def _carry_attached(self, to: str, data: Any) -> None:
        """In some data, put what is attached to a thing where that is."""
        body = self.model.body(to).id
        for thing, at in self.attached.items():
            if at.thing == to:
                self._put(data, thing, Pose.of(data.xpos[body], data.xmat[body]) @ at.pose)
        mujoco().mj_kinematics(self.model, data)

    def _put(self, data: Any, thing: str, pose: Pose) -> None:
        body = self.model.body(thing)
        mocap = int(body.mocapid[0])
        if mocap >= 0:
            data.mocap_pos[mocap], data.mocap_quat[mocap] = pose.position, pose.quaternion
            return
        joint = self.model.joint(thing)
        place, speed = int(joint.qposadr[0]), int(joint.dofadr[0])
        data.qpos[place : place + 3] = pose.position
        data.qpos[place + 3 : place + 7] = pose.quaternion
        data.qvel[speed : speed + 6] = 0

"""Moving arms by forces: servos, grasps by contact, and what goes wrong with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from skillwrapper.domains.tabletop.arms import GRIP, hand_of
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.kinematics import Joints
from skillwrapper.domains.tabletop.motion import FrameTaker, Motion, MotionFailed
from skillwrapper.domains.tabletop.poses import Pose, turn_z
from skillwrapper.domains.tabletop.welds import fasten, loosen
from skillwrapper.domains.tabletop.world import Held, TableWorld

_SPEED: Final = 1.4
"""Of the fastest joint, in radians per second."""
_SHORTEST: Final = 0.10
"""No motion takes less, in seconds."""
_AT_REST: Final = 1.5e-3, 1e-2
"""An arm whose joints are so near their goal, and so slow, has arrived."""
_LOOKS: Final = 50
"""So often is looked whether an arm has arrived, every ten steps."""
_CLOSING_STEPS: Final = 400
_PRESSING_STEPS: Final = 30
_OPENING_STEPS: Final = 100
_SETTLING_STEPS: Final = 200
_STEPS_PER_FRAME: Final = 40
_BACK_OFF: Final = 0.10
"""How far up an arm goes before it goes home from where something went wrong, in metres."""
_LOOSE: Final = 0.15
"""Share of the way to open fingers by which they begin beside what they hold."""
_LOST: Final = 0.05
"""A thing that is so far from where the gripper held it is lost, in metres."""


@dataclass(frozen=True)
class Troubles:
    """What goes wrong in the physical world.

    Attributes:
        pose_noise: standard deviation of where things are seen, along each axis of the table, in
            metres.
        turn_noise: likewise of how they are turned, in radians.
        slips: how often a thing slips out of the gripper in a motion, 0 to 1.
    """

    pose_noise: float = 0.0
    turn_noise: float = 0.0
    slips: float = 0.0


NO_TROUBLES: Final = Troubles()
CLUMSINESS: Final = Troubles(pose_noise=0.010, turn_noise=0.10, slips=0.01)
"""Of a robot whose camera and gripper are not what they should be."""


class PhysicsMotion(Motion):
    """Servos move the arms; a thing that both sides of a gripper touch is held.

    Args:
        world: with a ``weld`` for each arm and thing that it may hold.
        troubles: what goes wrong.
        seed: decides when, and how.
        on_frame: called with the world every 80 milliseconds of simulated time.
    """

    def __init__(
        self,
        world: TableWorld,
        troubles: Troubles = NO_TROUBLES,
        seed: int = 0,
        on_frame: FrameTaker | None = None,
    ) -> None:
        super().__init__(world, on_frame)
        self.troubles, self._chance = troubles, np.random.default_rng(seed)
        self._steps = 0
        self._moved: list[str] = []
        self._sides = {arm: self._sides_of(arm) for arm in world.arms}

    def restart(self, seed: int) -> None:
        """Begin with the world as it was just arranged: nothing moves, what is held is held."""
        self._chance = np.random.default_rng(seed)
        self._moved.clear()
        for arm, held in self.world.held.items():
            self._fasten(arm, held.thing)
        for name, arm_ in self.world.arms.items():
            self.world.data.ctrl[arm_.servos] = self.world.joints(name)
            opening = self._opening(name)
            # Fingers that begin inside a thing would fling it; they close on it from outside.
            loose = opening + _LOOSE * (arm_.kind.opened - opening)
            self.world.set_fingers(name, loose)
            self._set_fingers(name, opening)
        self._advance(_SETTLING_STEPS)

    def start(self, arm: str) -> Joints:
        """The joints that the servos aim at."""
        found: Joints = self.world.data.ctrl[self.world.arms[arm].servos].copy()
        return found

    def seen(self, pose: Pose) -> Pose:
        """A pose of a thing, not quite as it is."""
        x, y = self._chance.normal(0.0, 1.0, 2) * self.troubles.pose_noise
        turn = self._chance.normal() * self.troubles.turn_noise
        return Pose(pose.position + np.array([x, y, 0.0]), turn_z(turn) @ pose.rotation)

    def follow(self, arm: str, path: Sequence[Joints], pace: float = 1.0) -> None:
        """Aim the servos along a path and wait until the arm has arrived."""
        slip = arm in self.world.held and self._chance.random() < self.troubles.slips
        for number, joints in enumerate(path):
            if slip and number == len(path) // 2:
                self._unfasten(arm)
                # Strong fingers hold by friction what no weld holds.
                self._set_fingers(arm, self.world.arms[arm].kind.opened)
            self._aim(arm, joints, pace)
        self._arrive(arm)
        self._check_held(arm)

    def grasp(self, arm: str, thing: str, opening: float) -> None:
        """Close the fingers until both sides touch the thing; it is fastened then."""
        kind = self.world.arms[arm].kind
        first = self._opening(arm)
        for step in range(_CLOSING_STEPS):
            share = min(1.0, 2 * step / _CLOSING_STEPS)
            self._set_fingers(arm, first + (kind.closed - first) * share)
            self._advance(1)
            if self._touching_sides(arm, thing) >= 2:
                break
        else:
            self._set_fingers(arm, kind.opened)
            self._advance(_OPENING_STEPS)
            raise MotionFailed(f"the fingers do not close on the {thing}")
        self._advance(_PRESSING_STEPS)
        self._fasten(arm, thing)

    def release(self, arm: str) -> None:
        """Open the fingers; what was held is loose."""
        self._unfasten(arm)
        self.world.held.pop(arm, None)
        self._set_fingers(arm, self.world.arms[arm].kind.opened)
        self._advance(_OPENING_STEPS)

    def let_settle(self, thing: str, where: Pose) -> None:
        """Wait for it to come to rest."""
        self._advance(_SETTLING_STEPS)

    def retreat(self) -> None:
        """Bring all arms home after something went wrong, the one that moved last first."""
        others = [arm for arm in self.world.arms if arm not in self._moved]
        for arm in [*reversed(self._moved), *others]:
            self._retreat(arm)

    def _retreat(self, arm: str) -> None:
        """Bring an arm home, whatever is in the way."""
        x, y, z = self.world.grip(arm).position
        up = Pose(np.array([x, y, max(z + _BACK_OFF, 0.30)]), self.world.grip(arm).rotation)
        raised = self.world.arms[arm].solve(up, self.start(arm))
        path = [self.world.home[arm]] if raised is None else [raised, self.world.home[arm]]
        for joints in path:
            self._aim(arm, joints, 1.0)
        self._arrive(arm)
        self._drop_if_lost(arm)

    def _aim(self, arm: str, joints: Joints, pace: float) -> None:
        self._moved = [*(other for other in self._moved if other != arm), arm]
        servos, start = self.world.arms[arm].servos, self.start(arm)
        seconds = max(_SHORTEST, float(np.abs(joints - start).max()) / (_SPEED * pace))
        count = int(np.ceil(seconds / self.world.model.opt.timestep))
        for step in range(1, count + 1):
            share = step / count
            smooth = share * share * (3 - 2 * share)
            self.world.data.ctrl[servos] = start + smooth * (joints - start)
            self._advance(1)

    def _arrive(self, arm: str) -> None:
        mine, data = self.world.arms[arm], self.world.data
        for _ in range(_LOOKS):
            self._advance(10)
            off = np.abs(data.qpos[mine.addresses] - data.ctrl[mine.servos]).max()
            if off < _AT_REST[0] and np.abs(data.qvel[mine.velocities]).max() < _AT_REST[1]:
                return

    def _advance(self, steps: int) -> None:
        for _ in range(steps):
            mujoco().mj_step(self.world.model, self.world.data)
            self._steps += 1
            if self.on_frame is not None and self._steps % _STEPS_PER_FRAME == 0:
                self.on_frame(self.world)

    def _check_held(self, arm: str) -> None:
        thing = self.world.held[arm].thing if arm in self.world.held else None
        if self._drop_if_lost(arm):
            raise MotionFailed(f"the {thing} slipped out of the gripper")

    def _drop_if_lost(self, arm: str) -> bool:
        """Forget what an arm no longer holds."""
        held = self.world.held.get(arm)
        if held is None:
            return False
        expected = self.world.grip(arm) @ held.pose
        apart = np.linalg.norm(expected.position - self.world.pose(held.thing).position)
        if apart < _LOST:
            return False
        self.release(arm)
        return True

    def _fasten(self, arm: str, thing: str) -> None:
        """Weld a thing to the gripper as it is between the fingers."""
        model, data = self.world.model, self.world.data
        mujoco().mj_kinematics(model, data)
        fasten(model, data, hand_of(arm), thing)
        grip = self.world.grip(arm)
        self.world.held[arm] = Held(thing, grip.inverse() @ self.world.pose(thing))

    def _unfasten(self, arm: str) -> None:
        held = self.world.held.get(arm)
        if held is not None:
            loosen(self.world.model, self.world.data, hand_of(arm), held.thing)

    def _opening(self, arm: str) -> float:
        """How far the fingers are open, by the first of them."""
        mine = self.world.arms[arm]
        first = next(iter(mine.kind.finger_joints.values()))
        return float(self.world.data.qpos[mine.fingers[0]] / first)

    def _set_fingers(self, arm: str, opening: float) -> None:
        for servo, sign in self.world.arms[arm].kind.servos.items():
            number = self.world.model.actuator(f"{arm}_{GRIP}_{servo}").id
            self.world.data.ctrl[number] = sign * opening

    def _touching_sides(self, arm: str, thing: str) -> int:
        """How many sides of a gripper touch a thing."""
        body = self.world.model.body(thing).id
        bodies = self.world.model.geom_bodyid
        sides = set()
        for first, second in self.world.data.contact.geom:
            for mine, other in ((first, second), (second, first)):
                if bodies[other] == body and int(bodies[mine]) in self._sides[arm]:
                    sides.add(self._sides[arm][int(bodies[mine])])
        return len(sides)

    def _sides_of(self, arm: str) -> dict[int, bool]:
        """For every body of a gripper's fingers, whether it is on the side of the first finger."""
        model, grip = self.world.model, self.world.grip(arm).inverse()
        hand = model.body(hand_of(arm)).id
        places = {}
        for body in range(model.nbody):
            above = body
            while above not in (0, hand):
                above = int(model.body_parentid[above])
            if above == hand and model.body_weldid[body] != model.body_weldid[hand]:
                places[body] = (grip @ self.world.pose(model.body(body).name)).position[:2]
        first = next(iter(places.values()))
        return {body: bool(place @ first > 0) for body, place in places.items()}

"""Moving arms: along paths that are free, grasping and releasing; without forces, at once."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterator, Sequence
from typing import Final

import numpy as np

from skillwrapper.domains.tabletop.collisions import Clearance
from skillwrapper.domains.tabletop.kinematics import Joints, between
from skillwrapper.domains.tabletop.poses import Pose
from skillwrapper.domains.tabletop.world import Held, TableWorld

CHECKED_STEP: Final = 0.05
"""No joint moves farther between two looks at what is touched, in radians."""
_FILMED_STEP: Final = 0.11
"""What the fastest joint does from frame to frame: 80 milliseconds at the speed of servos."""
_STRAIGHT_STEP: Final = 0.02
"""Metres between the points of a straight line."""
_DETOUR_HEIGHTS: Final = (0.30, 0.42)
"""How high the grip goes to get over what is in its way, in metres."""

FrameTaker = Callable[[TableWorld], None]


class MotionFailed(Exception):  # noqa: N818 -- what happened to a skill, no mistake of anybody
    """A motion cannot be done, or went wrong; the message says why, without a full stop."""


class Motion(ABC):
    """What arms can do in a world; how it is done is up to who derives from it.

    Args:
        world: in which they move.
        on_frame: called with the world now and then during motions, e.g. for a video.
    """

    def __init__(self, world: TableWorld, on_frame: FrameTaker | None = None) -> None:
        self.world, self.on_frame = world, on_frame
        self._clearance = Clearance(world)

    @abstractmethod
    def follow(self, arm: str, path: Sequence[Joints], pace: float = 1.0) -> None:
        """Move along joints that were found to be free.

        Args:
            arm: its name.
            path: joints after joints (joints,).
            pace: 1 for the usual speed.

        Raises:
            MotionFailed: if something goes wrong on the way.
        """

    @abstractmethod
    def grasp(self, arm: str, thing: str, opening: float) -> None:
        """Close the gripper on a thing.

        Args:
            arm: its name.
            thing: what is between its fingers.
            opening: of the fingers when they touch it, as in ``ArmKind.opened``.

        Raises:
            MotionFailed: if it is not caught.
        """

    @abstractmethod
    def release(self, arm: str) -> None:
        """Open the gripper."""

    @abstractmethod
    def let_settle(self, thing: str, where: Pose) -> None:
        """Let a thing that was released come to rest, just under where it was held.

        Args:
            thing: its name.
            where: it rests if all went well.
        """

    def seen(self, pose: Pose) -> Pose:
        """A pose of a thing as the robot sees it; here as it is."""
        return pose

    def move_to(
        self, arm: str, target: Pose, *, touching: Collection[str] = (), pace: float = 1.0
    ) -> None:
        """Bring the grip to a pose on a free path, around what is in the way.

        Args:
            arm: its name.
            target: of the grip.
            touching: names of what may be touched.
            pace: 1 for the usual speed.

        Raises:
            MotionFailed: if it is out of reach, or there is no free path.
        """
        joints = self.world.arms[arm].solve(target, self.start(arm))
        if joints is None:
            raise MotionFailed(f"{_spot(target)} is out of reach")
        self.travel(arm, joints, touching=touching, pace=pace)

    def move_straight(
        self, arm: str, target: Pose, *, touching: Collection[str] = (), pace: float = 0.6
    ) -> None:
        """Bring the grip to a pose on a straight line.

        Args:
            arm: its name.
            target: of the grip.
            touching: names of what may be touched.
            pace: 1 for the usual speed.

        Raises:
            MotionFailed: if it is out of reach, or something is in the way.
        """
        self._clearance.renew()
        path, joints = [], self.start(arm)
        first = self.world.arms[arm].grip(self.world.data).position
        count = max(1, int(np.ceil(np.linalg.norm(target.position - first) / _STRAIGHT_STEP)))
        for k in range(1, count + 1):
            point = first + (target.position - first) * k / count
            found = self.world.arms[arm].solve(Pose(point, target.rotation), joints)
            if found is None:
                raise MotionFailed(f"{_spot(target)} is out of reach")
            obstacle = self._obstacle(arm, joints, [found], touching)
            if obstacle is not None:
                raise MotionFailed(f"{_called(obstacle)} is in the way")
            path.append(found)
            joints = found
        self.follow(arm, path, pace)

    def travel(
        self, arm: str, joints: Joints, *, touching: Collection[str] = (), pace: float = 1.0
    ) -> None:
        """Bring the joints somewhere on a free path, around what is in the way.

        Raises:
            MotionFailed: if there is no free path.
        """
        self._clearance.renew()
        start, obstacle = self.start(arm), None
        for path in self._paths(arm, start, joints):
            met = self._obstacle(arm, start, path, touching)
            if met is None:
                self.follow(arm, path, pace)
                return
            obstacle = obstacle or met
        raise MotionFailed(f"{_called(str(obstacle))} is in the way")

    def go_home(self, arm: str) -> None:
        """Bring an arm to where it waits.

        Raises:
            MotionFailed: if there is no free path.
        """
        self.travel(arm, self.world.home[arm])

    def is_free(self, arm: str, joints: Joints, touching: Collection[str] = ()) -> bool:
        """Whether an arm would touch nothing with its joints so."""
        self._clearance.renew()
        return self._clearance.touched(arm, joints, touching) is None

    def start(self, arm: str) -> Joints:
        """The joints from which the next motion starts."""
        return self.world.joints(arm)

    def _obstacle(
        self, arm: str, start: Joints, path: Sequence[Joints], touching: Collection[str]
    ) -> str | None:
        for joints in path:
            for step in between(start, joints, CHECKED_STEP):
                touched = self._clearance.touched(arm, step, touching)
                if touched is not None:
                    return touched
            start = joints
        return None

    def _paths(self, arm: str, start: Joints, end: Joints) -> Iterator[list[Joints]]:
        """Straight ahead, then over what is in the way, then by way of home."""
        yield [end]
        for height in _DETOUR_HEIGHTS:
            ends = [self._raised(arm, joints, height) for joints in (start, end)]
            if all(joints is not None for joints in ends):
                yield [*(joints for joints in ends if joints is not None), end]
        home = self.world.home[arm]
        yield [home, end]
        raised = self._raised(arm, end, _DETOUR_HEIGHTS[0])
        if raised is not None:
            yield [home, raised, end]

    def _raised(self, arm: str, joints: Joints, height: float) -> Joints | None:
        """Joints with the grip above where others have it."""
        mine, data = self.world.arms[arm], self._clearance.data_with(arm, joints)
        grip = mine.grip(data)
        if grip.position[2] >= height:
            return joints
        x, y, _ = grip.position
        return mine.solve(Pose(np.array([x, y, height]), grip.rotation), joints)


class KinematicMotion(Motion):
    """Arms go where they are told at once; what they hold goes along.

    Without ``on_frame`` only the ends of motions are looked at.
    """

    def follow(self, arm: str, path: Sequence[Joints], pace: float = 1.0) -> None:
        """Joints take their last value; with ``on_frame``, also all between."""
        if self.on_frame is not None:
            present = self.start(arm)
            for joints in path:
                for step in between(present, joints, _FILMED_STEP * pace):
                    self.world.set_joints(arm, step)
                    self.on_frame(self.world)
                present = joints
        self.world.set_joints(arm, path[-1])

    def grasp(self, arm: str, thing: str, opening: float) -> None:
        """The thing goes with the gripper from now on."""
        pose = self.world.grip(arm).inverse() @ self.world.pose(thing)
        self.world.held[arm] = Held(thing, pose)
        self.world.set_fingers(arm, opening)
        self.world.refresh()

    def release(self, arm: str) -> None:
        """The thing stays where it is."""
        self.world.held.pop(arm, None)
        self.world.set_fingers(arm, self.world.arms[arm].kind.opened)
        self.world.refresh()

    def let_settle(self, thing: str, where: Pose) -> None:
        """It is where it shall be."""
        self.world.put(thing, where)


def _spot(pose: Pose) -> str:
    x, y, z = pose.position
    return f"the place ({x:.2f}, {y:.2f}, {z:.2f})"


def _called(obstacle: str) -> str:
    return f"the {obstacle}"

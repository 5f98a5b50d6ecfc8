"""The five skills, as motions; the same ones without forces and with them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Final

import numpy as np

from skillwrapper.domains.panda.objects import HANDLING, MUG_HEIGHT, MUG_RADIUS, PLATE_TOP, SPOUT
from skillwrapper.domains.panda.states import MUG, PLATE, SPONGE, TEAPOT
from skillwrapper.domains.panda.table import ARM, HOME_GRIP, PandaTable
from skillwrapper.domains.tabletop.kinematics import Joints
from skillwrapper.domains.tabletop.motion import Motion, MotionFailed
from skillwrapper.domains.tabletop.poses import Pose, turn_y, turn_z
from skillwrapper.world.skills import SkillInstance

_ABOVE: Final = 0.12
"""How high over a thing the gripper stops before it goes straight down, in metres."""
_LET_GO: Final = 0.003
"""How high over its place a thing is let go."""
_TILT: Final = 0.75
"""How far the teapot is tilted, in radians."""
_SPONGE_REACH: Final = (0.048, 0.031)
"""Half of the sponge's lower side; what lies under it is wiped away."""
_WIPING_HEIGHT: Final = 0.012
"""A sponge whose lower side is no higher over the plate wipes it."""
_ROUNDS: Final = (0.020, 0.042)
"""Radii of the circles in which the plate is wiped."""


class PandaSkills:
    """Runs skills on a table.

    Args:
        table: on which.
        motion: how the arm moves.
    """

    def __init__(self, table: PandaTable, motion: Motion) -> None:
        self._table, self._motion = table, motion
        self._skills: Mapping[str, Callable[..., None]] = {
            "Pick": self.pick,
            "Place": self.place,
            "Pour": lambda *_: self.pour(),
            "Stack": lambda thing, _: self.stack(thing),
            "Wipe": lambda *_: self.wipe(),
        }

    def run(self, instance: SkillInstance) -> None:
        """Run a skill that is not known to fail; the arm is at home before and after.

        Raises:
            MotionFailed: if it went wrong.
        """
        _, *arguments = instance.arguments
        self._skills[instance.skill](*arguments)

    def pick(self, thing: str) -> None:
        """Take a thing from above, lift it and bring it home."""
        grip = self._motion.seen(self._table.grip_pose(thing, self._table.world.pose(thing)))
        self._motion.move_to(ARM, grip.shifted(z=_ABOVE))
        self._motion.move_straight(ARM, grip, touching={thing})
        self._motion.grasp(ARM, thing, HANDLING[thing].opening)
        self._motion.move_straight(ARM, grip.shifted(z=_ABOVE), touching=self._support())
        self._motion.go_home(ARM)

    def place(self, thing: str) -> None:
        """Put a thing back to where it started."""
        self._put_down(self._table.start_pose(thing), {"table"})

    def stack(self, thing: str) -> None:
        """Put a thing onto the middle of the plate."""
        self._put_down(self._table.stacked_pose(thing), {PLATE})

    def pour(self) -> None:
        """Bring the spout over the mug, tilt the teapot, and set it upright again."""
        upright, tilted = self._pouring_joints()
        self._motion.travel(ARM, upright)
        self._motion.travel(ARM, tilted, pace=0.5)
        if not self._spout_is_over_mug():
            raise MotionFailed(f"the spout is not over the {MUG}")
        self._table.full = True
        self._table.show()
        self._motion.travel(ARM, upright)
        self._motion.go_home(ARM)

    def wipe(self) -> None:
        """Rub the plate with the sponge in circles."""
        held = self._table.world.held[ARM].pose
        middle = self._table.world.pose(PLATE).position
        turn = HOME_GRIP.rotation @ held.rotation  # as it hangs at home
        low = PLATE_TOP + HANDLING[SPONGE].rest + _LET_GO

        def grip_at(x: float, y: float, height: float) -> Pose:
            return Pose(middle + np.array([x, y, height]), turn) @ held.inverse()

        self._motion.move_to(ARM, grip_at(0.0, 0.0, low + _ABOVE))
        self._motion.move_straight(ARM, grip_at(0.0, 0.0, low), touching={PLATE})
        self._rub()
        for radius in _ROUNDS:
            for angle in np.linspace(0, 2 * np.pi, 9):
                x, y = radius * np.cos(angle), radius * np.sin(angle)
                self._motion.move_straight(ARM, grip_at(x, y, low), touching={PLATE})
                self._rub()
        self._motion.move_straight(ARM, grip_at(0.0, 0.0, low + _ABOVE), touching={PLATE})
        self._motion.go_home(ARM)

    def _put_down(self, where: Pose, support: set[str]) -> None:
        """Lower what is held to a pose, let go, and come home."""
        world = self._table.world
        thing = world.held[ARM].thing
        grip = where.shifted(z=_LET_GO) @ world.held[ARM].pose.inverse()
        self._motion.move_to(ARM, grip.shifted(z=_ABOVE))
        self._motion.move_straight(ARM, grip, touching=support)
        self._motion.release(ARM)
        self._motion.let_settle(thing, where)
        self._motion.move_straight(ARM, grip.shifted(z=_ABOVE), touching={thing})
        self._motion.go_home(ARM)

    def _support(self) -> set[str]:
        return {"table", PLATE}

    def _rub(self) -> None:
        """What lies under the sponge now is wiped away."""
        sponge = self._table.world.pose(SPONGE)
        for number in sorted(self._table.residue):
            spot = sponge.inverse() @ Pose(self._table.residue_place(number), np.eye(3))
            x, y, z = spot.position
            under = abs(x) < _SPONGE_REACH[0] and abs(y) < _SPONGE_REACH[1]
            if under and -HANDLING[SPONGE].rest - _WIPING_HEIGHT < z:
                self._table.residue.discard(number)
        self._table.show()

    def _spout_is_over_mug(self) -> bool:
        """Whether what leaves the spout would fall into the mug."""
        teapot, mug = self._table.world.pose(TEAPOT), self._table.world.pose(MUG)
        tip = teapot.position + teapot.rotation @ SPOUT - mug.position
        tilt = np.arccos(np.clip(teapot.rotation[2, 2], -1.0, 1.0))
        inside = np.hypot(tip[0], tip[1]) < MUG_RADIUS - 0.01
        return bool(inside and 0 < tip[2] - MUG_HEIGHT < 0.10 and tilt > _TILT / 2)

    def _pouring_joints(self) -> tuple[Joints, Joints]:
        """Joints with the spout over the mug, upright and tilted, from a side that is free."""
        for directions in self._pouring_grips():
            joints, start = [], self._motion.start(ARM)
            for grip in directions:
                found = self._table.world.arms[ARM].solve(grip, start)
                if found is None or not self._motion.is_free(ARM, found):
                    break
                joints.append(found)
                start = found
            else:
                return joints[0], joints[1]
        raise MotionFailed(f"the {MUG} cannot be reached with the spout")

    def _pouring_grips(self) -> Iterator[tuple[Pose, Pose]]:
        """Upright and tilted grips, from the sides in the order in which they are tried."""
        world = self._table.world
        held, mug = world.held[ARM].pose, world.pose(MUG).position
        inward = -1.0 if mug[1] < 0 else 1.0  # the teapot between the mug and the middle
        for direction in (inward * a for a in (1.57, 2.1, 1.0, 2.6, 3.14, 0.5, 0.0, -1.57)):
            grips = []
            for tilt, height in ((0.0, 0.10), (_TILT, 0.04)):
                rotation = turn_z(direction) @ turn_y(tilt)
                tip = mug + np.array([0.0, 0.0, MUG_HEIGHT + height])
                grips.append(Pose(tip - rotation @ SPOUT, rotation) @ held.inverse())
            yield grips[0], grips[1]

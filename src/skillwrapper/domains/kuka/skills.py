"""The six skills, as motions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

import numpy as np

from skillwrapper.domains.kuka.objects import (
    BLADE_TIP,
    BLADE_WIDTH,
    BREAD_HEIGHT,
    JAR_HEIGHT,
    JAR_RADIUS,
    LID,
    TOPPING_PLACES,
)
from skillwrapper.domains.kuka.states import BREAD, COATED, JAR, KNIFE, USED
from skillwrapper.domains.kuka.table import (
    FROM_THE_LEFT,
    JAR_OPENING,
    KNIFE_OPENING,
    LAID_DOWN,
    LEFT,
    LID_OPENING,
    LID_PLACE,
    RIGHT,
    KukaTable,
)
from skillwrapper.domains.tabletop.motion import Motion, MotionFailed
from skillwrapper.domains.tabletop.poses import Pose, Vector, grip_along
from skillwrapper.world.skills import SkillInstance

_BEFORE: Final = 0.13
"""How far before the jar the left hand stops before it goes straight on, in metres."""
_ABOVE: Final = 0.14
_OUT_OF_HOLDER: Final = 0.17
_IN_FRONT: Final = Pose(np.array([0.46, 0.06, 0.26]), FROM_THE_LEFT)
"""Where the left hand holds the jar while the right one works on it."""
_OVER_BREAD: Final = 0.09
_LET_GO: Final = 0.003
_INTO_JAR: Final = 0.05
"""How deep the blade goes into the jar."""
_SPREADING: Final = grip_along((0.50, 0.08, -0.80), across=(0.0, 1.0, 0.0))
"""How the right hand holds the knife over the bread: its flat side leans on it."""
_STROKES: Final = (-0.02, 0.0, 0.02)
"""Where strokes go, along the bread's x axis."""
_ON_BREAD: Final = 0.015
"""A blade whose tip is no higher over the bread touches it, in metres."""
_DEEP: Final = 0.03
"""So far under the jar's rim the blade's tip is in peanut butter, in metres."""


class KukaSkills:
    """Runs skills on a table.

    Args:
        table: on which.
        motion: how the arms move.
    """

    def __init__(self, table: KukaTable, motion: Motion) -> None:
        self._table, self._motion = table, motion
        self._skills: Mapping[str, Callable[[], None]] = {
            "LeftArmPick": self.pick_jar,
            "RightArmPick": self.pick_knife,
            "Open": self.open_jar,
            "Scoop": self.scoop,
            "Spread": self.spread,
            "Drop": self.drop,
        }

    def run(self, instance: SkillInstance) -> None:
        """Run a skill that is not known to fail; the arms are at home before and after.

        Raises:
            MotionFailed: if it went wrong.
        """
        self._skills[instance.skill]()

    def pick_jar(self) -> None:
        """Take the jar from the left, lift it and bring it home."""
        grip = self._motion.seen(self._table.jar_grip(self._table.world.pose(JAR)))
        self._motion.move_to(LEFT, grip.ahead(-_BEFORE))
        self._motion.move_straight(LEFT, grip, touching={JAR, LID})
        self._motion.grasp(LEFT, JAR, JAR_OPENING)
        self._motion.move_straight(LEFT, grip.shifted(z=_ABOVE), touching={"table"})
        self._motion.go_home(LEFT)

    def pick_knife(self) -> None:
        """Pull the knife out of its holder and bring it home."""
        if RIGHT in self._table.world.held:
            thing = self._table.world.held[RIGHT].thing
            raise MotionFailed(f"the right hand is full: it holds the {thing}")
        grip = self._motion.seen(self._table.knife_grip(self._table.world.pose(KNIFE)))
        self._motion.move_to(RIGHT, grip.shifted(z=_ABOVE))
        self._motion.move_straight(RIGHT, grip, touching={KNIFE, "holder"})
        self._motion.grasp(RIGHT, KNIFE, KNIFE_OPENING)
        self._table.world.detach(KNIFE)
        self._motion.move_straight(RIGHT, grip.shifted(z=_OUT_OF_HOLDER), touching={"holder"})
        self._motion.go_home(RIGHT)

    def open_jar(self) -> None:
        """Hold the jar in front, take its lid off, and lay it down."""
        self._motion.move_to(LEFT, _IN_FRONT)
        grip = self._table.lid_grip(self._motion.seen(self._table.world.pose(LID)))
        self._motion.move_to(RIGHT, grip.shifted(z=_ABOVE))
        self._motion.move_straight(RIGHT, grip, touching={LID, JAR, LEFT})
        self._motion.grasp(RIGHT, LID, LID_OPENING)
        self._table.world.detach(LID)
        self._motion.move_straight(RIGHT, grip.shifted(z=_ABOVE), touching={JAR, LEFT})
        self._motion.go_home(LEFT)
        self._lay_lid_down()
        self._motion.go_home(RIGHT)

    def scoop(self) -> None:
        """Hold the jar in front, dip the blade into it, and bring both hands home."""
        self._motion.move_to(LEFT, _IN_FRONT)
        jar = self._motion.seen(self._table.world.pose(JAR))
        deep = jar.position + np.array([0.0, 0.0, JAR_HEIGHT - _INTO_JAR + BLADE_TIP])
        grip = Pose(deep, np.eye(3)) @ self._table.world.held[RIGHT].pose.inverse()
        self._motion.move_to(RIGHT, grip.shifted(z=_INTO_JAR + _ABOVE / 2))
        self._motion.move_straight(RIGHT, grip, touching={JAR})
        self._dip()
        self._motion.move_straight(RIGHT, grip.shifted(z=_INTO_JAR + _ABOVE / 2), touching={JAR})
        self._motion.go_home(RIGHT)
        self._motion.go_home(LEFT)

    def spread(self) -> None:
        """Draw the blade over the bread."""
        bread = self._motion.seen(self._table.world.pose(BREAD))
        for number, x in enumerate(_STROKES):
            over = self._tip_at(bread.position + bread.rotation @ np.array([x, 0.0, 0.0]))
            if number == 0:
                self._motion.move_to(RIGHT, over.shifted(z=_OVER_BREAD))
            self._motion.move_straight(RIGHT, over, touching={BREAD})
            self._cover()
        self._motion.move_straight(RIGHT, over.shifted(z=_OVER_BREAD), touching={BREAD})
        self._motion.go_home(RIGHT)
        if not self._table.is_spread():
            raise MotionFailed("the blade has missed most of the bread")

    def drop(self) -> None:
        """Lower the knife to the table and let it fall flat."""
        held = self._table.world.held[RIGHT].pose
        low = Pose(LAID_DOWN.position, self._table.world.home_grip(RIGHT).rotation @ held.rotation)
        grip = low.shifted(z=0.6 * BLADE_TIP) @ held.inverse()
        self._motion.move_to(RIGHT, grip)
        self._motion.release(RIGHT)
        self._motion.let_settle(KNIFE, LAID_DOWN)
        self._motion.go_home(RIGHT)

    def _lay_lid_down(self) -> None:
        grip = self._table.lid_grip(LID_PLACE).shifted(z=_LET_GO)
        self._motion.move_to(RIGHT, grip.shifted(z=_ABOVE))
        self._motion.move_straight(RIGHT, grip, touching={"table"})
        self._motion.release(RIGHT)
        self._motion.let_settle(LID, LID_PLACE)
        self._motion.move_straight(RIGHT, grip.shifted(z=_ABOVE), touching={LID})

    def _dip(self) -> None:
        """Peanut butter sticks to a blade whose tip is in the open jar."""
        jar, tip = self._table.world.pose(JAR), self._tip()
        x, y, z = (jar.inverse() @ tip).position
        if not (np.hypot(x, y) < JAR_RADIUS and 0 < z < JAR_HEIGHT - _DEEP):
            raise MotionFailed("the blade is not in the jar")
        self._table.blade = COATED
        self._table.show()

    def _cover(self) -> None:
        """Spots of bread that the end of the blade lies on are covered; of most, it is used up."""
        end = self._table.world.pose(BREAD).inverse() @ self._tip()
        if end.position[2] < BREAD_HEIGHT + _ON_BREAD:
            places = enumerate(TOPPING_PLACES)
            self._table.topping.update(n for n, (x, y, r) in places if _from_end(end, x, y) < r)
        if self._table.is_spread():
            self._table.blade = USED
        self._table.show()

    def _tip(self) -> Pose:
        """The middle of the blade's end, which is as wide as the blade along y."""
        return self._table.world.pose(KNIFE) @ Pose.at(0.0, 0.0, -BLADE_TIP)

    def _tip_at(self, place: Vector) -> Pose:
        """The grip with the blade's tip on the bread at a place."""
        rotation = _SPREADING @ self._table.world.held[RIGHT].pose.rotation
        tip = place + np.array([0.0, 0.0, BREAD_HEIGHT + 0.006])
        knife = Pose(tip + BLADE_TIP * rotation[:, 2], rotation)
        return knife @ self._table.world.held[RIGHT].pose.inverse()


def _from_end(end: Pose, x: float, y: float) -> float:
    """How far a place is from the end of the blade, both seen from above, in metres."""
    across = BLADE_WIDTH * end.rotation[:2, 1]
    offset = np.array([x, y]) - end.position[:2]
    share = np.clip(offset @ across / (across @ across), -1.0, 1.0)
    return float(np.linalg.norm(offset - share * across))

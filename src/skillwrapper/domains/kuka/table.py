"""The two arms' table as it is: a world with a layout, and what can be told by looking at it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from skillwrapper.domains.kuka.cameras import CAMERAS
from skillwrapper.domains.kuka.objects import (
    ADD,
    COATING,
    HOLDER,
    JAR_GRIP,
    KNIFE_IN_HOLDER,
    KNIFE_ON_TABLE,
    LID,
    LID_HEIGHT,
    LID_ON_JAR,
    SMEAR,
    TOPPING,
    TOPPING_PLACES,
    USUAL,
    Look,
)
from skillwrapper.domains.kuka.states import (
    BREAD,
    CLEAN,
    COATED,
    IN_HAND,
    IN_HOLDER,
    JAR,
    KNIFE,
    ON_TABLE,
    USED,
    Blade,
    KnifePlace,
    KukaState,
)
from skillwrapper.domains.tabletop.arms import IIWA, add_arm, weld
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.layout import Layout
from skillwrapper.domains.tabletop.poses import Matrix, Pose, grip_along, grip_down, quaternion_of
from skillwrapper.domains.tabletop.shapes import VISIBLE
from skillwrapper.domains.tabletop.stage import DAYLIGHT, Lighting, new_stage
from skillwrapper.domains.tabletop.welds import FIRM, LOOSE, add_weld
from skillwrapper.domains.tabletop.world import ArmSetup, TableWorld

LEFT, RIGHT = "left", "right"
_SHOULDERS: Final = (0.0, 0.09, 0.62)
"""Where the left arm begins; the right one mirrors it."""
_REST: Final = (0.0, 0.9, 0.0, -1.5, 0.0, 0.6, 0.0)
FROM_THE_LEFT: Final[Matrix] = grip_along((0.15, -1.0, -0.25), across=(1.0, 0.0, 0.0))
"""How the left hand takes the jar: its fingers close forwards and backwards."""
FROM_THE_RIGHT: Final[Matrix] = grip_along((0.0, 0.8, -0.6), across=(1.0, 0.0, 0.0))
"""How the right hand waits: what hangs in it shows its flat side to the robot's eye."""
LEFT_HOME: Final = Pose(np.array([0.48, 0.40, 0.22]), FROM_THE_LEFT)
RIGHT_HOME: Final = Pose(np.array([0.45, -0.44, 0.24]), FROM_THE_RIGHT)
LAID_DOWN: Final = Pose(
    np.array([0.34, -0.26, KNIFE_ON_TABLE]), grip_along((0.0, -1.0, 0.0), across=(1.0, 0.0, 0.0))
)
"""Where the knife lies once it was dropped."""
LID_PLACE: Final = Pose.at(0.58, -0.02, LID_HEIGHT / 2)
"""Where the lid lies once the jar was opened."""
JAR_OPENING, LID_OPENING, KNIFE_OPENING = 0.28, 0.28, 0.57
"""Of the fingers when they touch a thing."""
JAR_DEPTH, LID_DEPTH, KNIFE_DEPTH = 0.018, -0.009, 0.010
"""How far the fingers' pads are then behind the grip, in metres."""
_LEAST_SPREAD: Final = 0.5
"""Bread with a smaller share of its spots is bare."""
_STANDS: Final = 0.06
"""A jar that was pushed no farther than this may stay there, in metres."""
_UPRIGHT: Final = 0.9
"""Of a jar that leans no more than this, cosine of how much."""
_FLAT: Final = 0.03
"""What lies on the table has its middle no higher, in metres."""


@dataclass(frozen=True)
class Setting:
    """What the table looks like and how the light falls.

    Attributes:
        look: of the things.
        lighting: of the room.
    """

    look: Look = USUAL
    lighting: Lighting = DAYLIGHT


class KukaTable:
    """The things on the table, with peanut butter where it is.

    Args:
        setting: what it looks like.

    Attributes:
        world: with all things.
        layout: where the things started.
        blade: clean, coated or used.
        topping: numbers of the spots of peanut butter on the bread.
    """

    def __init__(self, setting: Setting) -> None:
        arms = [ArmSetup(LEFT, IIWA, _REST), ArmSetup(RIGHT, IIWA, _REST)]
        self.world = TableWorld(_model(setting), arms)
        for arm, home in ((LEFT, LEFT_HOME), (RIGHT, RIGHT_HOME)):
            found = self.world.arms[arm].solve(home)
            if found is not None:
                self.world.home[arm] = self.world.arms[arm].rest = found
        self.layout: Layout = {}
        self.blade: Blade = CLEAN
        self.topping: set[int] = set()

    def arrange(self, state: KukaState, layout: Layout) -> None:
        """Set everything up as a state says, the arms at home."""
        world = self.world
        self.layout = layout
        world.clear()
        world.put(HOLDER, layout[HOLDER].pose(0.0))
        world.put(BREAD, layout[BREAD].pose(0.0))
        world.put(JAR, layout[JAR].pose(0.0))
        world.put(KNIFE, self.knife_in_holder() if state.knife != ON_TABLE else LAID_DOWN)
        if state.opened:
            world.put(LID, LID_PLACE)
        else:
            world.attach(LID, JAR, Pose.at(0.0, 0.0, LID_ON_JAR))
        if state.knife == IN_HOLDER:
            world.attach(KNIFE, HOLDER, HOLDER_TO_KNIFE)
        if state.jar_held:
            world.give(LEFT, JAR, self.jar_grip(world.pose(JAR)), JAR_OPENING)
        if state.knife == IN_HAND:
            world.give(RIGHT, KNIFE, self.knife_grip(world.pose(KNIFE)), KNIFE_OPENING)
        self.blade = state.blade
        self.topping = set(range(len(TOPPING_PLACES))) if state.spread else set()
        self.show()

    def show(self) -> None:
        """Show peanut butter as it is."""
        self.world.show(COATING, self.blade == COATED)
        self.world.show(SMEAR, self.blade == USED)
        for number in range(len(TOPPING_PLACES)):
            self.world.show(f"{TOPPING}{number}", number in self.topping)

    def knife_in_holder(self) -> Pose:
        """The knife upright in its holder."""
        return self.layout[HOLDER].pose(0.0) @ HOLDER_TO_KNIFE

    def jar_grip(self, jar: Pose) -> Pose:
        """How the left hand takes the jar."""
        return Pose(jar.position, FROM_THE_LEFT).shifted(z=JAR_GRIP).ahead(JAR_DEPTH)

    def knife_grip(self, knife: Pose) -> Pose:
        """How the right hand takes the upright knife: from above, fingers beside its flat side."""
        y = knife.rotation[:, 1]
        return Pose(knife.position, grip_down(float(np.arctan2(y[1], y[0])))).ahead(KNIFE_DEPTH)

    def lid_grip(self, lid: Pose) -> Pose:
        """How the right hand takes the lid: from above, fingers before and behind it."""
        return Pose(lid.position, grip_down(0.0)).ahead(LID_DEPTH)

    def state(self) -> KukaState:
        """The abstract state, told by where things are."""
        held = {held.thing for held in self.world.held.values()}
        in_holder = KNIFE in self.world.attached
        knife: KnifePlace = IN_HAND if KNIFE in held else IN_HOLDER if in_holder else ON_TABLE
        return KukaState(
            jar_held=JAR in held,
            opened=LID not in self.world.attached,
            knife=knife,
            blade=self.blade,
        )

    def is_spread(self) -> bool:
        """Whether most of the bread is covered."""
        return len(self.topping) / len(TOPPING_PLACES) > _LEAST_SPREAD

    def displaced(self) -> str | None:
        """What lies where no skill leaves it, in words; None if nothing does."""
        jar, start = self.world.pose(JAR), self.layout[JAR].pose(0.0)
        if jar.rotation[2, 2] < _UPRIGHT:
            return f"the {JAR} is not upright"
        if (
            self.world.holder(JAR) is None
            and np.linalg.norm(jar.position - start.position) > _STANDS
        ):
            return f"the {JAR} is not where it belongs"
        loose = [LID] if self.world.holder(KNIFE) else [LID, KNIFE]
        for thing in loose:
            high = self.world.pose(thing).position[2] > _FLAT
            if high and thing not in self.world.attached:
                return f"the {thing} does not lie on the table"
        return None


HOLDER_TO_KNIFE: Final = Pose.at(0.0, 0.0, KNIFE_IN_HOLDER)
"""The upright knife, as its holder sees it."""


def _model(setting: Setting) -> Any:
    stage = new_stage(CAMERAS, setting.lighting, table=(0.50, 0.54, 0.57, 1.0))
    x, y, z = _SHOULDERS
    for arm, side in ((LEFT, 1), (RIGHT, -1)):
        turn = np.array([[1, 0, 0], [0, 0, side], [0, -side, 0]], float)
        add_arm(stage, IIWA, arm, (x, side * y, z), tuple(quaternion_of(turn)))
    torso = {
        "type": mujoco().mjtGeom.mjGEOM_BOX,
        "size": [0.10, 0.10, 0.36],
        "pos": [-0.02, 0, 0.36],
    }
    stage.worldbody.add_geom(name="torso", rgba=[0.25, 0.26, 0.28, 1], **torso, **VISIBLE)
    for add in ADD:
        add(stage, setting.look)
    weld(stage, LEFT, JAR, FIRM)
    for thing in (KNIFE, LID):
        weld(stage, RIGHT, thing, FIRM)
    add_weld(stage, JAR, LID, FIRM)
    add_weld(stage, HOLDER, KNIFE, LOOSE)
    return stage.compile()

"""The table as it is: a world with a layout, and what can be told of it by looking at it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from skillwrapper.domains.panda.cameras import CAMERAS
from skillwrapper.domains.panda.objects import (
    ADD,
    HANDLING,
    PLATE_RADIUS,
    PLATE_TOP,
    RESIDUE,
    RESIDUE_PLACES,
    TEA,
    USUAL,
    Look,
)
from skillwrapper.domains.panda.states import BOWL, PICKUPABLE, PLATE, THINGS, PandaState
from skillwrapper.domains.tabletop.arms import PANDA, add_arm, weld
from skillwrapper.domains.tabletop.layout import Layout
from skillwrapper.domains.tabletop.poses import Pose, Vector, grip_down
from skillwrapper.domains.tabletop.stage import DAYLIGHT, Lighting, new_stage
from skillwrapper.domains.tabletop.world import ArmSetup, Held, TableWorld

ARM: Final = "arm"
_HOME: Final = (0.0, -0.75, 0.0, -2.45, 0.0, 1.75, 0.785)
HOME_GRIP: Final = Pose(np.array([0.36, 0.0, 0.36]), grip_down(0.0))
"""Where the gripper waits."""
_PUT_BACK: Final = 0.06
"""A thing that was pushed no farther than this may stay there, in metres."""
_LEFT_DIRTY: Final = 0.25
"""A plate with a larger share of its residue than this is dirty."""


@dataclass(frozen=True)
class Setting:
    """What the table looks like and how the light falls.

    Attributes:
        look: of the things.
        lighting: of the room.
    """

    look: Look = USUAL
    lighting: Lighting = DAYLIGHT


class PandaTable:
    """The things on the table, with residue and tea.

    Args:
        setting: what it looks like.

    Attributes:
        world: with all things, those of other scenes put away.
        layout: where the things of the scene started.
        residue: numbers of the spots of food that are left.
        full: whether there is tea in the mug.
    """

    def __init__(self, setting: Setting) -> None:
        self.world = TableWorld(_model(setting), [ArmSetup(ARM, PANDA, _HOME)])
        home = self.world.arms[ARM].solve(HOME_GRIP)
        if home is not None:
            self.world.home[ARM] = home
        self.layout: Layout = {}
        self.residue: set[int] = set()
        self.full = False

    def arrange(self, state: PandaState, layout: Layout) -> None:
        """Set everything up as a state says, the arm at home."""
        world = self.world
        self.layout = layout
        world.clear()
        for thing in THINGS:
            if thing in layout:
                world.put(thing, layout[thing].pose(HANDLING[thing].rest))
            else:
                world.put_away(thing)
        if state.stacked is not None:
            world.put(state.stacked, self.stacked_pose(state.stacked))
        if state.held is not None:
            self._give(state.held)
        self.full = state.full
        self.residue = set(range(len(RESIDUE_PLACES))) if state.dirty else set()
        self.show()

    def show(self) -> None:
        """Show tea and residue as they are."""
        self.world.show(TEA, self.full)
        for number in range(len(RESIDUE_PLACES)):
            self.world.show(f"{RESIDUE}{number}", number in self.residue and PLATE in self.layout)

    def start_pose(self, thing: str) -> Pose:
        """Where a thing started."""
        return self.layout[thing].pose(HANDLING[thing].rest)

    def stacked_pose(self, thing: str) -> Pose:
        """Where a thing stands on the plate, turned as it started."""
        plate = self.world.pose(PLATE).position
        height = PLATE_TOP + HANDLING[thing].rest
        return Pose.at(plate[0], plate[1], height, self.layout[thing].yaw)

    def grip_pose(self, thing: str, pose: Pose) -> Pose:
        """How the gripper takes a thing that is somewhere: from above, fingers along its y axis."""
        turned = Pose.at(*pose.position) if thing == BOWL else pose
        point = turned.position + turned.rotation @ np.array(HANDLING[thing].grip)
        y = turned.rotation[:, 1]
        # Fingers are alike, so of two ways the one nearer to the hand at home is taken.
        direction = float(np.arctan2(y[1], y[0]) if y[0] >= 0 else np.arctan2(-y[1], -y[0]))
        return Pose(point, grip_down(direction))

    def state(self) -> PandaState:
        """The abstract state, told by where things are."""
        held = self.world.held.get(ARM)
        share = len(self.residue) / len(RESIDUE_PLACES)
        return PandaState(
            held=None if held is None else held.thing,
            stacked=next((t for t in PICKUPABLE if self.is_stacked(t)), None),
            dirty=share > _LEFT_DIRTY,
            full=self.full,
        )

    def is_stacked(self, thing: str) -> bool:
        """Whether a thing stands upright on the plate and nobody holds it."""
        if not {PLATE, thing} <= set(self.layout) or self.world.holder(thing) is not None:
            return False
        pose, plate = self.world.pose(thing), self.world.pose(PLATE).position
        across = np.hypot(*(pose.position - plate)[:2])
        height = pose.position[2] - HANDLING[thing].rest
        return bool(across < PLATE_RADIUS / 2 and abs(height) < 0.02 and _is_upright(pose))

    def is_in_place(self, thing: str, tolerance: float = 0.03) -> bool:
        """Whether a thing stands upright on the table where it started."""
        pose, start = self.world.pose(thing), self.start_pose(thing)
        offset = pose.position - start.position
        near = np.hypot(*offset[:2]) < tolerance and abs(offset[2]) < 0.01
        return bool(near and _is_upright(pose))

    def displaced(self) -> str | None:
        """A thing that neither is held nor on the plate and is not where it belongs."""
        for thing in PICKUPABLE:
            loose = thing in self.layout and self.world.holder(thing) is None
            if loose and not self.is_stacked(thing) and not self.is_in_place(thing, _PUT_BACK):
                return f"the {thing} is not where it belongs"
        return None

    def residue_place(self, number: int) -> Vector:
        """Where a spot of food is on the plate (3,)."""
        x, y = RESIDUE_PLACES[number]
        return np.asarray(self.world.pose(PLATE).position + np.array([x, y, PLATE_TOP]))

    def _give(self, thing: str) -> None:
        """Put a thing into the gripper as ``Pick`` would have taken it."""
        start = self.start_pose(thing)
        relative = self.grip_pose(thing, start).inverse() @ start
        self.world.held[ARM] = Held(thing, relative)
        self.world.set_fingers(ARM, HANDLING[thing].opening)
        self.world.refresh()
        self.world.carry(ARM, self.world.data)


def _is_upright(pose: Pose) -> bool:
    return bool(pose.rotation[2, 2] > 0.97)


def _model(setting: Setting) -> Any:
    stage = new_stage(CAMERAS, setting.lighting)
    add_arm(stage, PANDA, ARM)
    for add in ADD.values():
        add(stage, setting.look)
    for thing in PICKUPABLE:
        weld(stage, ARM, thing)
    return stage.compile()

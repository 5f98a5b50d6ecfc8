"""Whether the simulated arms can be tested here, and a small world with one."""

from __future__ import annotations

from functools import cache

import pytest

from skillwrapper.domains.tabletop.arms import PANDA, add_arm
from skillwrapper.domains.tabletop.cameras import Camera
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.photos import Photographer
from skillwrapper.domains.tabletop.robot_models import model_file
from skillwrapper.domains.tabletop.shapes import SOLID, VISIBLE
from skillwrapper.domains.tabletop.stage import add_object, new_stage
from skillwrapper.domains.tabletop.world import ArmSetup, TableWorld
from skillwrapper.errors import MissingDependencyError

HOME = (0.0, -0.75, 0.0, -2.45, 0.0, 1.75, 0.785)


def one_arm() -> TableWorld:
    """A Panda at a table with two blocks that are away."""
    stage = new_stage({"front": Camera((1.32, 0.0, 0.8), (0.42, 0.0, 0.1), 42.0)})
    add_arm(stage, PANDA, "arm")
    for name in ("block", "tower"):
        half = [0.02, 0.02, 0.02 if name == "block" else 0.15]
        body = add_object(stage, name, mass=0.1, centre=(0.0, 0.0, 0.0))
        for look in (VISIBLE, SOLID):
            body.add_geom(type=mujoco().mjtGeom.mjGEOM_BOX, size=half, rgba=[0.9, 0, 0, 1], **look)
    return TableWorld(stage.compile(), [ArmSetup("arm", PANDA, HOME)])


@cache
def why_no_arms() -> str:
    """What is missing for motions; empty if nothing is."""
    try:
        mujoco(), model_file("panda")
    except MissingDependencyError as error:
        return str(error)
    return ""


@cache
def why_no_pictures() -> str:
    """What is missing for pictures; empty if nothing is."""
    if why_no_arms():
        return why_no_arms()
    try:
        Photographer(64, 48).take(one_arm(), "front")
    except MissingDependencyError as error:
        return str(error)
    return ""


needs_arms = pytest.mark.skipif(bool(why_no_arms()), reason=why_no_arms())

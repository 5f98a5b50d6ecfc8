"""The empty stage: floor, table, light and cameras."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from skillwrapper.domains.tabletop.cameras import Camera
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.poses import quaternion_of
from skillwrapper.domains.tabletop.shapes import VISIBLE

Colour = tuple[float, float, float, float]
PARKING_HEIGHT = 5.0
"""Where things are that a scene has not: far above everything, unseen."""


@dataclass(frozen=True)
class Lighting:
    """How the stage is lit.

    Attributes:
        strength: 1 for the usual light.
        shadows: whether the lamp casts any; they take most of the time of a picture.
        warmth: how much redder than white, from -1 (blue) to 1 (red).
    """

    strength: float = 1.0
    shadows: bool = False
    warmth: float = 0.0

    def colour(self, level: float) -> list[float]:
        """Of a light of a level, in red, green and blue."""
        tint = (1 + 0.25 * self.warmth, 1.0, 1 - 0.35 * self.warmth)
        return [level * self.strength * part for part in tint]


DAYLIGHT = Lighting()
"""The usual light."""


def new_stage(
    cameras: Mapping[str, Camera],
    lighting: Lighting = DAYLIGHT,
    table: Colour = (0.72, 0.57, 0.41, 1.0),
    table_middle: tuple[float, float] = (0.32, 0.0),
    table_size: tuple[float, float] = (1.0, 1.3),
) -> Any:
    """An MjSpec with a table whose top is z = 0.

    Args:
        cameras: by name.
        lighting: how it is lit.
        table: its colour.
        table_middle: x and y of its middle.
        table_size: its length along x and y.
    """
    stage = mujoco().MjSpec()
    _set_options(stage, lighting)
    _add_room(stage, lighting)
    _add_table(stage, table, table_middle, table_size)
    for name, camera in cameras.items():
        add_camera(stage, name, camera)
    return stage


def add_camera(stage: Any, name: str, camera: Camera) -> None:
    """Put a camera onto the stage."""
    stage.worldbody.add_camera(
        name=name,
        pos=list(camera.position),
        quat=quaternion_of(camera.rotation).tolist(),
        fovy=camera.field_of_view,
    )


def add_object(
    stage: Any,
    name: str,
    *,
    mass: float,
    centre: tuple[float, float, float] = (0.0, 0.0, 0.02),
    inertia: float = 1.5e-4,
) -> Any:
    """A body that can be moved, without geoms.

    Args:
        stage: where.
        name: of the body and its joint.
        mass: in kilograms.
        centre: of its mass, in its own frame.
        inertia: around each axis; larger than true for small things, which keeps them calm.
    """
    body = stage.worldbody.add_body(name=name, pos=[0, 0, PARKING_HEIGHT])
    body.add_freejoint(name=name)
    body.explicitinertial = True
    body.mass, body.inertia, body.ipos = mass, [inertia] * 3, list(centre)
    return body


def add_fixture(stage: Any, name: str) -> Any:
    """A body without geoms that nothing moves but ``TableWorld.put``."""
    return stage.worldbody.add_body(name=name, mocap=True, pos=[0, 0, PARKING_HEIGHT])


def _set_options(stage: Any, lighting: Lighting) -> None:
    m = mujoco()
    stage.option.timestep = 0.002
    stage.option.integrator = m.mjtIntegrator.mjINT_IMPLICITFAST
    stage.option.cone = m.mjtCone.mjCONE_ELLIPTIC
    stage.option.impratio = 10
    stage.stat.extent, stage.stat.center = 1.5, [0.5, 0, 0.2]
    visual = stage.visual
    # The largest pictures that can be taken.
    visual.global_.offwidth, visual.global_.offheight = 1280, 960
    visual.quality.offsamples = 4
    visual.quality.shadowsize = 2048
    visual.map.znear = 0.02
    visual.headlight.ambient = lighting.colour(0.34)
    visual.headlight.diffuse = lighting.colour(0.22)
    visual.headlight.specular = lighting.colour(0.10)


def _add_room(stage: Any, lighting: Lighting) -> None:
    m = mujoco()
    stage.add_texture(
        name="sky",
        type=m.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=m.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.80, 0.84, 0.88],
        rgb2=[0.62, 0.66, 0.70],
        width=128,
        height=128,
    )
    stage.worldbody.add_light(
        pos=[0.8, -1.0, 1.8],
        dir=[-0.2, 0.5, -1],
        diffuse=lighting.colour(0.48),
        specular=lighting.colour(0.15),
        castshadow=lighting.shadows,
    )
    stage.worldbody.add_geom(
        name="floor",
        type=m.mjtGeom.mjGEOM_PLANE,
        size=[4, 4, 0.1],
        pos=[0, 0, -0.75],
        rgba=[0.55, 0.55, 0.56, 1],
        group=1,
    )


def _add_table(
    stage: Any, colour: Colour, middle: tuple[float, float], size: tuple[float, float]
) -> None:
    box = mujoco().mjtGeom.mjGEOM_BOX
    x, y = middle
    half_x, half_y = size[0] / 2, size[1] / 2
    stage.worldbody.add_geom(
        name="table",
        type=box,
        size=[half_x, half_y, 0.02],
        pos=[x, y, -0.02],
        rgba=list(colour),
        group=1,
        friction=[1, 0.01, 0.001],
    )
    wood = [0.66 * part for part in colour[:3]]
    for side_x in (-1, 1):
        for side_y in (-1, 1):
            stage.worldbody.add_geom(
                type=box,
                size=[0.03, 0.03, 0.355],
                pos=[x + side_x * (half_x - 0.05), y + side_y * (half_y - 0.05), -0.395],
                rgba=[*wood, 1],
                **VISIBLE,
            )

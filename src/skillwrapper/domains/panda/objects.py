"""The things on the table, made of MuJoCo's primitives and of meshes of our own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from skillwrapper.domains.panda.states import BOWL, MUG, PLATE, SPONGE, TEAPOT
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.poses import Vector
from skillwrapper.domains.tabletop.shapes import SOLID, VISIBLE, add_mesh, add_ring, lathe, sweep
from skillwrapper.domains.tabletop.stage import Colour, add_fixture, add_object

TEA: Final = "mug_tea"
RESIDUE: Final = "plate_residue"
"""What the names of the geoms begin with that come and go."""

MUG_RADIUS, MUG_HEIGHT = 0.042, 0.095
PLATE_RADIUS, PLATE_TOP = 0.105, 0.006
RESIDUE_PLACES: Final = tuple(
    (radius * np.cos(angle), radius * np.sin(angle))
    for angle, radius in zip(
        2 * np.pi * np.array([0.00, 0.12, 0.21, 0.33, 0.45, 0.55, 0.67, 0.78, 0.90]),
        (0.046, 0.022, 0.050, 0.034, 0.050, 0.020, 0.046, 0.030, 0.052),
        strict=True,
    )
)
"""Middle (x, y) of every spot of food on the plate, from the plate's."""
_SPOT_SIZES: Final = (0.015, 0.013, 0.011, 0.017, 0.012, 0.014, 0.012, 0.016, 0.012)


@dataclass(frozen=True)
class Look:
    """Colours and proportions of the things: one set of instances.

    Attributes:
        mug: its colour.
        teapot: likewise.
        plate: likewise.
        bowl: likewise.
        sponge: its upper side.
        pad: its lower side.
        tea: what is in the mug.
        residue: of food.
        slender: how much slimmer and taller vessels are than usual, 1 for not at all.
    """

    mug: Colour = (0.80, 0.10, 0.10, 1)
    teapot: Colour = (0.10, 0.35, 0.85, 1)
    plate: Colour = (0.93, 0.93, 0.92, 1)
    bowl: Colour = (0.10, 0.62, 0.25, 1)
    sponge: Colour = (0.98, 0.85, 0.10, 1)
    pad: Colour = (0.20, 0.38, 0.14, 1)
    tea: Colour = (0.33, 0.16, 0.05, 1)
    residue: Colour = (0.28, 0.12, 0.05, 1)
    slender: float = 1.0


USUAL: Final = Look()
OTHERS: Final = replace(
    USUAL,
    mug=(0.72, 0.14, 0.22, 1),
    teapot=(0.16, 0.28, 0.66, 1),
    plate=(0.90, 0.88, 0.82, 1),
    bowl=(0.20, 0.52, 0.34, 1),
    sponge=(0.92, 0.72, 0.20, 1),
    residue=(0.36, 0.18, 0.06, 1),
    slender=0.9,
)
"""Other mugs, teapots, ... of the same kinds, in colours like those of the usual ones."""


@dataclass(frozen=True)
class Handling:
    """How a thing is handled; lengths in metres, places from the thing's own frame.

    Attributes:
        radius: of the circle around it that is kept free when it is placed.
        rest: height of its frame when it stands on something flat.
        grip: where it is gripped (3,).
        opening: of the fingers when they touch it there.
    """

    radius: float
    rest: float
    grip: tuple[float, float, float] = (0.0, 0.0, 0.0)
    opening: float = 0.0


HANDLING: Final[Mapping[str, Handling]] = MappingProxyType(
    {
        MUG: Handling(0.075, 0.0),
        TEAPOT: Handling(0.115, 0.045, (0.0, 0.0, 0.095), 0.0055),
        PLATE: Handling(0.135, 0.0),
        BOWL: Handling(0.080, 0.0, (0.0, -0.0585, 0.046), 0.006),
        SPONGE: Handling(0.065, 0.0175, (0.0, 0.0, 0.006), 0.030),
    }
)
SPOUT: Final[Vector] = np.array([0.112, 0.0, 0.035])
"""Tip of the teapot's spout in its frame (3,)."""


def add_mug(stage: Any, look: Look) -> None:
    """A mug with a handle, and tea that can be shown or hidden."""
    body, geom = add_fixture(stage, MUG), mujoco().mjtGeom
    radius, height = MUG_RADIUS, MUG_HEIGHT
    wall = [(0, 0), (radius * 0.9, 0), (radius, 0.006), (radius, height), (radius - 0.005, height)]
    add_mesh(stage, "mug_wall", lathe([*wall, (radius - 0.006, 0.012), (0, 0.010)]))
    angles = np.linspace(-np.pi / 2, np.pi / 2, 14)
    bow = [(radius - 0.003 + 0.03 * np.cos(a), 0.0, 0.05 + 0.03 * np.sin(a)) for a in angles]
    add_mesh(stage, "mug_handle", sweep(bow, [0.006] * len(bow)))
    for part in ("wall", "handle"):
        _add_part(body, MUG, part, look.mug)
    disc = {"type": geom.mjGEOM_CYLINDER, **VISIBLE}
    body.add_geom(
        name=TEA,
        size=[radius - 0.0055, 0.001, 0],
        pos=[0, 0, height - 0.010],
        rgba=look.tea,
        **disc,
    )
    inside = [0.95, 0.92, 0.88, 1]
    body.add_geom(
        name="mug_inside", size=[radius - 0.007, 0.001, 0], pos=[0, 0, 0.014], rgba=inside, **disc
    )
    add_ring(body, "mug_solid", radius - 0.002, height, 0.0, **SOLID)


def add_teapot(stage: Any, look: Look) -> None:
    """A round teapot with a spout along x and a handle over it along x."""
    body, geom = add_object(stage, TEAPOT, mass=0.25, centre=(0, 0, 0)), mujoco().mjtGeom
    z, slim = -HANDLING[TEAPOT].rest, look.slender
    belly = [(0, 0), (0.040, 0), (0.058, 0.018), (0.064, 0.038), (0.056, 0.060)]
    lid = [(0.034, 0.074), (0.030, 0.076), (0.028, 0.080), (0.012, 0.088), (0, 0.089)]
    add_mesh(stage, "teapot_belly", lathe([(r * slim, h + z) for r, h in (*belly, *lid)]))
    along = np.linspace(0, 1, 12)
    spout = [(0.050 + 0.062 * s, 0, z + 0.028 + 0.052 * s**1.6) for s in along]
    add_mesh(stage, "teapot_spout", sweep(spout, 0.015 - 0.009 * along))
    angles = np.linspace(0, np.pi, 20)
    bow = [(0.050 * np.cos(a), 0.0, z + 0.066 + 0.074 * np.sin(a)) for a in angles]
    add_mesh(stage, "teapot_handle", sweep(bow, [0.0055] * len(bow)))
    black = (0.12, 0.12, 0.14, 1.0)
    for part, colour in (("belly", look.teapot), ("spout", look.teapot), ("handle", black)):
        _add_part(body, TEAPOT, part, colour)
    body.add_geom(
        name="teapot_knob",
        type=geom.mjGEOM_SPHERE,
        size=[0.008, 0, 0],
        pos=[0, 0, z + 0.094],
        rgba=black,
        **VISIBLE,
    )
    body.add_geom(
        name="teapot_solid",
        type=geom.mjGEOM_CYLINDER,
        size=[0.058, 0.038, 0],
        pos=[0, 0, z + 0.038],
        **SOLID,
    )
    body.add_geom(
        name="teapot_solid_spout",
        type=geom.mjGEOM_CAPSULE,
        fromto=[0.055, 0, z + 0.035, 0.106, 0, z + 0.074],
        size=[0.008, 0, 0],
        **SOLID,
    )
    body.add_geom(
        name="teapot_solid_handle",
        type=geom.mjGEOM_CAPSULE,
        size=[0.006, 0.02, 0],
        pos=[0, 0, z + 0.140],
        quat=[0.7071, 0, 0.7071, 0],
        condim=4,
        **SOLID,
    )


def add_plate(stage: Any, look: Look) -> None:
    """A flat plate, and residue of food that can be shown or hidden, spot by spot."""
    body, geom = add_fixture(stage, PLATE), mujoco().mjtGeom
    below = [(0, 0), (0.055, 0), (0.060, 0.003), (PLATE_RADIUS, 0.016)]
    above = [(PLATE_RADIUS, 0.019), (0.066, 0.008), (0.060, PLATE_TOP), (0, PLATE_TOP)]
    add_mesh(stage, "plate_dish", lathe([*below, *above], 56))
    _add_part(body, PLATE, "dish", look.plate)
    for number, ((x, y), size) in enumerate(zip(RESIDUE_PLACES, _SPOT_SIZES, strict=True)):
        body.add_geom(
            name=f"{RESIDUE}{number}",
            type=geom.mjGEOM_ELLIPSOID,
            size=[size, 0.85 * size, 0.0035],
            pos=[x, y, PLATE_TOP + 0.001],
            rgba=look.residue,
            **VISIBLE,
        )
    body.add_geom(
        name="plate_solid",
        type=geom.mjGEOM_CYLINDER,
        size=[0.062, PLATE_TOP / 2, 0],
        pos=[0, 0, PLATE_TOP / 2],
        **SOLID,
    )
    add_ring(body, "plate_solid_rim", 0.083, 0.006, 0.004, thickness=0.020, sides=18, **SOLID)


def add_bowl(stage: Any, look: Look) -> None:
    """A bowl that is gripped at its rim."""
    body, geom = add_object(stage, BOWL, mass=0.15), mujoco().mjtGeom
    radius, height = 0.062, 0.055
    outside = [(0, 0.002), (0.028, 0), (0.030, 0.004), (0.048, 0.018), (0.058, 0.036)]
    inside = [(0.054, 0.037), (0.044, 0.021), (0.026, 0.008), (0, 0.006)]
    profile = [*outside, (radius, height), (radius - 0.004, height), *inside]
    add_mesh(stage, "bowl_wall", lathe(profile))
    _add_part(body, BOWL, "wall", look.bowl)
    body.add_geom(
        name="bowl_solid",
        type=geom.mjGEOM_CYLINDER,
        size=[0.032, 0.004, 0],
        pos=[0, 0, 0.004],
        **SOLID,
    )
    rim = {"thickness": 0.003, **SOLID}
    add_ring(body, "bowl_solid_rim", radius - 0.003, 0.032, height - 0.032, condim=4, **rim)
    add_ring(body, "bowl_solid_side", radius - 0.018, 0.022, 0.006, **rim)


def add_sponge(stage: Any, look: Look) -> None:
    """A sponge, yellow above and dark green below."""
    body = add_object(stage, SPONGE, mass=0.04, centre=(0, 0, 0), inertia=2e-5)
    box = {"type": mujoco().mjtGeom.mjGEOM_BOX}
    half = [0.048, 0.031]
    upper = {"size": [*half, 0.013], "pos": [0, 0, 0.0045], "rgba": look.sponge}
    lower = {"size": [*half, 0.0045], "pos": [0, 0, -0.013], "rgba": look.pad}
    body.add_geom(name="sponge_upper", **upper, **box, **VISIBLE)
    body.add_geom(name="sponge_pad", **lower, **box, **VISIBLE)
    body.add_geom(name="sponge_solid", size=[*half, 0.0175], condim=4, **box, **SOLID)


ADD: Final[Mapping[str, Callable[[Any, Look], None]]] = MappingProxyType(
    {MUG: add_mug, TEAPOT: add_teapot, PLATE: add_plate, BOWL: add_bowl, SPONGE: add_sponge}
)
"""How each thing is put onto a stage."""


def _add_part(body: Any, thing: str, part: str, colour: Colour) -> None:
    body.add_geom(
        name=f"{thing}_{part}",
        type=mujoco().mjtGeom.mjGEOM_MESH,
        meshname=f"{thing}_{part}",
        rgba=list(colour),
        **VISIBLE,
    )

"""Jar, lid, knife, holder and bread, made of MuJoCo's primitives and of meshes of our own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from skillwrapper.domains.kuka.states import BREAD, JAR, KNIFE
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.shapes import SOLID, VISIBLE, Mesh, add_mesh, add_ring, lathe
from skillwrapper.domains.tabletop.stage import Colour, add_fixture, add_object

LID, HOLDER = "lid", "holder"
COATING: Final = "knife_coating"
SMEAR: Final = "knife_smear"
TOPPING: Final = "bread_topping"
"""What the names of the geoms begin with that come and go."""

JAR_RADIUS, JAR_HEIGHT = 0.040, 0.105
JAR_GRIP: Final = 0.060
"""How high over its foot the jar is gripped."""
LID_HEIGHT: Final = 0.020
LID_ON_JAR: Final = JAR_HEIGHT - 0.004
"""Height of the lid's middle over the foot of a closed jar."""
HOLDER_RADIUS, HOLDER_HEIGHT = 0.036, 0.130
HANDLE_RADIUS: Final = 0.012
BLADE_TIP: Final = 0.190
"""How far the tip of the blade is from the middle of the handle."""
BLADE_WIDTH: Final = 0.021
"""Half of it."""
KNIFE_IN_HOLDER: Final = 0.215
"""Height of the middle of its handle."""
KNIFE_ON_TABLE: Final = 0.012
BREAD_SIZE: Final = (0.062, 0.060)
"""Half of its length and width."""
BREAD_HEIGHT: Final = 0.018
_BLADE_START: Final = 0.048
_SPOTS: Final = 11


@dataclass(frozen=True)
class Look:
    """Colours of the things: one set of instances.

    Attributes:
        butter: of peanut butter.
        lid: of the jar.
        label: likewise.
        handle: of the knife.
        blade: likewise.
        holder: of the knife.
        crust: of the bread.
        crumb: likewise.
    """

    butter: Colour = (0.74, 0.49, 0.17, 1)
    lid: Colour = (0.10, 0.55, 0.20, 1)
    label: Colour = (0.88, 0.84, 0.88, 1)
    handle: Colour = (0.14, 0.12, 0.58, 1)
    blade: Colour = (0.86, 0.87, 0.90, 1)
    holder: Colour = (0.10, 0.52, 0.56, 1)
    crust: Colour = (0.48, 0.27, 0.10, 1)
    crumb: Colour = (0.93, 0.84, 0.64, 1)


USUAL: Final = Look()
OTHERS: Final = replace(
    USUAL,
    butter=(0.66, 0.42, 0.15, 1),
    lid=(0.16, 0.44, 0.14, 1),
    label=(0.80, 0.74, 0.86, 1),
    handle=(0.24, 0.16, 0.50, 1),
    blade=(0.78, 0.78, 0.80, 1),
    holder=(0.16, 0.44, 0.52, 1),
    crumb=(0.88, 0.76, 0.56, 1),
)
"""Another jar, knife and bread, in colours like those of the usual ones."""


def add_jar(stage: Any, look: Look) -> None:
    """A jar full of peanut butter, without its lid."""
    body, geom = add_object(stage, JAR, mass=0.3, centre=(0, 0, 0.05)), mujoco().mjtGeom
    r, h = JAR_RADIUS, JAR_HEIGHT
    outside = [(0, 0), (r - 0.003, 0), (r, 0.004), (r, h - 0.018), (r - 0.004, h - 0.010)]
    inside = [(r - 0.004, h), (r - 0.007, h), (r - 0.007, h - 0.012), (0, h - 0.012)]
    _add_part(body, JAR, "glass", add_mesh(stage, "jar_glass", lathe([*outside, *inside])), look)
    disc = {"type": geom.mjGEOM_CYLINDER, **VISIBLE}
    label = {"size": [r + 0.0008, 0.022, 0], "pos": [0, 0, 0.044], "rgba": look.label}
    body.add_geom(name="jar_label", **label, **disc)
    body.add_geom(
        name="jar_foot", type=geom.mjGEOM_CYLINDER, size=[r, 0.006, 0], pos=[0, 0, 0.006], **SOLID
    )
    wall = h - 0.016  # the lid rests on it
    add_ring(body, "jar_wall", r - 0.003, wall, 0.0, thickness=0.003, condim=4, **SOLID)


def add_lid(stage: Any, look: Look) -> None:
    """Its lid, with grooves."""
    body = add_object(stage, LID, mass=0.03, centre=(0, 0, 0), inertia=2e-5)
    geom, half = mujoco().mjtGeom, LID_HEIGHT / 2
    r = JAR_RADIUS - 0.001
    cylinder, dark = {"type": geom.mjGEOM_CYLINDER}, [0.8 * c for c in look.lid[:3]]
    body.add_geom(name="lid_cap", size=[r, half, 0], rgba=look.lid, **cylinder, **VISIBLE)
    for number in range(24):
        angle = 2 * np.pi * number / 24
        body.add_geom(
            name=f"lid_groove{number}",
            type=geom.mjGEOM_CAPSULE,
            size=[0.0016, half - 0.002, 0],
            pos=[r * np.cos(angle), r * np.sin(angle), 0],
            rgba=[*dark, 1],
            **VISIBLE,
        )
    body.add_geom(name="lid_solid", size=[r, half, 0], condim=4, **cylinder, **SOLID)


def add_knife(stage: Any, look: Look) -> None:
    """A broad knife: its frame is in the middle of the handle, the blade along -z, flat along y."""
    body = add_object(stage, KNIFE, mass=0.06, centre=(0, 0, -0.04), inertia=1e-4)
    geom = mujoco().mjtGeom
    handle = {"type": geom.mjGEOM_CAPSULE, "size": [HANDLE_RADIUS, 0.040, 0]}
    body.add_geom(name="knife_handle", rgba=look.handle, **handle, **VISIBLE)
    hard = {"solref": [0.006, 1.0]}  # or it dips deep into the table when it falls
    body.add_geom(name="knife_solid", condim=4, **hard, **handle, **SOLID)
    add_mesh(stage, "knife_blade", _blade())
    steel = {"type": geom.mjGEOM_MESH, "meshname": "knife_blade", "rgba": look.blade}
    body.add_geom(name="knife_blade", **steel, **VISIBLE)
    body.add_geom(
        name="knife_solid_blade",
        type=geom.mjGEOM_BOX,
        size=[0.003, BLADE_WIDTH - 0.004, (BLADE_TIP - _BLADE_START) / 2],
        pos=[0, 0, -(BLADE_TIP + _BLADE_START) / 2],
        **SOLID,
    )
    lump = {"type": geom.mjGEOM_ELLIPSOID, **VISIBLE}
    for number, (size, z, shade) in enumerate(
        [((0.016, 0.026, 0.056), 0.132, 1.0), ((0.019, 0.017, 0.026), 0.150, 1.08)]
    ):
        colour = [*(min(1.0, shade * c) for c in look.butter[:3]), 1]
        body.add_geom(name=f"{COATING}{number}", size=size, pos=[0, 0, -z], rgba=colour, **lump)
    streak = {"size": [0.0040, 0.0085, 0.034], "rgba": look.butter}
    body.add_geom(name=SMEAR, pos=[0, 0.003, -0.145], **streak, **lump)


def add_holder(stage: Any, look: Look) -> None:
    """A beaker in which the knife stands."""
    body, r, h = add_fixture(stage, HOLDER), HOLDER_RADIUS, HOLDER_HEIGHT
    mesh = lathe([(0, 0), (r, 0), (r, h), (r - 0.004, h), (r - 0.004, 0.008), (0, 0.006)])
    add_mesh(stage, "holder_wall", mesh)
    body.add_geom(
        name="holder_wall",
        type=mujoco().mjtGeom.mjGEOM_MESH,
        meshname="holder_wall",
        rgba=look.holder,
        **VISIBLE,
    )
    add_ring(body, "holder_solid", r - 0.003, h, 0.0, thickness=0.003, **SOLID)
    floor = (KNIFE_IN_HOLDER - BLADE_TIP) / 2  # the blade stands on it
    body.add_geom(
        name="holder_solid_floor",
        type=mujoco().mjtGeom.mjGEOM_CYLINDER,
        size=[r - 0.006, floor, 0],
        pos=[0, 0, floor],
        **SOLID,
    )


def add_bread(stage: Any, look: Look) -> None:
    """A slice of bread, and peanut butter on it that can be shown or hidden, spot by spot."""
    body, geom = add_fixture(stage, BREAD), mujoco().mjtGeom
    length, width = BREAD_SIZE
    half = BREAD_HEIGHT / 2
    for part, colour, inset, rise in (
        ("crust", look.crust, 0.0, 0.0),
        ("crumb", look.crumb, 0.006, 0.0008),
    ):
        box = {"type": geom.mjGEOM_BOX, "pos": [0, 0, half], "rgba": colour}
        body.add_geom(
            name=f"bread_{part}",
            size=[length - inset, width - inset, half + rise],
            **box,
            **VISIBLE,
        )
        for side in (-1, 1):
            body.add_geom(
                name=f"bread_{part}{side}",
                type=geom.mjGEOM_CYLINDER,
                size=[0.036 - inset, half + rise, 0],
                pos=[length - 0.012, side * 0.029, half],
                rgba=colour,
                **VISIBLE,
            )
    for number, (x, y, size) in enumerate(TOPPING_PLACES):
        body.add_geom(
            name=f"{TOPPING}{number}",
            type=geom.mjGEOM_ELLIPSOID,
            size=[size, 0.85 * size, 0.005],
            pos=[x, y, BREAD_HEIGHT + 0.0015],
            rgba=look.butter,
            **VISIBLE,
        )
    solid = {"size": [length, width, half], "pos": [0, 0, half]}
    body.add_geom(name="bread_solid", type=geom.mjGEOM_BOX, **solid, **SOLID)


ADD: Final = (add_jar, add_lid, add_knife, add_holder, add_bread)
"""How everything is put onto a stage."""


def _places_of_topping() -> tuple[tuple[float, float, float], ...]:
    """Middle (x, y), from the bread's, and size of every spot, in the order of a spiral."""
    numbers = np.arange(_SPOTS)
    radii, angles = 0.036 * np.sqrt(numbers / _SPOTS), 2.4 * numbers
    sizes = 0.017 + 0.004 * np.sin(5 * numbers)
    return tuple(
        (float(r * np.cos(a)), float(r * np.sin(a)), float(s))
        for r, a, s in zip(radii, angles, sizes, strict=True)
    )


TOPPING_PLACES: Final = _places_of_topping()


def _blade() -> Mesh:
    """A flat blade with a round tip, along -z."""
    along = np.linspace(0, 1, 16)
    z = -_BLADE_START - along * (BLADE_TIP - _BLADE_START)
    wide = BLADE_WIDTH * np.sqrt(np.clip(1 - np.abs((along - 0.45) / 0.58) ** 5, 0.02, 1))
    corners = [(-0.0015, -1), (-0.0015, 1), (0.0015, 1), (0.0015, -1)]
    vertices = [
        (x, side * w, height) for height, w in zip(z, wide, strict=True) for x, side in corners
    ]
    faces, last = [(0, 1, 2), (0, 2, 3)], 4 * (len(along) - 1)
    for ring in range(len(along) - 1):
        for corner in range(4):
            a, b = 4 * ring + corner, 4 * ring + (corner + 1) % 4
            faces += [(a, a + 4, b), (b, a + 4, b + 4)]
    faces += [(last, last + 2, last + 1), (last, last + 3, last + 2)]
    return np.array(vertices), np.array(faces)


def _add_part(body: Any, thing: str, part: str, mesh: str, look: Look) -> None:
    body.add_geom(
        name=f"{thing}_{part}",
        type=mujoco().mjtGeom.mjGEOM_MESH,
        meshname=mesh,
        rgba=look.butter,
        **VISIBLE,
    )

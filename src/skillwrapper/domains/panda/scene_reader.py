"""Reading pictures of the table: pixels in, a scene graph out.

It knows the colours and shapes of the things and where cameras stand, as whoever sets up a camera
does, and nothing of the simulator's state.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np

from skillwrapper.domains.panda.cameras import CAMERAS
from skillwrapper.domains.panda.colours import BROWN, PORCELAIN, WOOD, materials
from skillwrapper.domains.panda.states import BOWL, MUG, PICKUPABLE, PLATE, ROBOT, SPONGE, TEAPOT
from skillwrapper.domains.panda.table_map import around, best_disc, seen_from_above
from skillwrapper.domains.tabletop.cameras import HEIGHT, WIDTH
from skillwrapper.domains.tabletop.colours import Mask
from skillwrapper.domains.tabletop.views import camera_of
from skillwrapper.embedded.pixels import decode_pixels
from skillwrapper.embedded.scene_graph import Box, SceneGraph, Thing
from skillwrapper.errors import PictureError

_FEWEST: Final = 80
"""So many pixels of a colour are a thing and no accident."""
_PLATE_RADIUS: Final = 0.105
_PLATE_SHARE: Final = 0.12
"""A disc of which less is white is no plate, even one under other things."""
_FLAT_PART: Final = 0.066
"""Radius of the part of the plate where food sticks."""
_RESIDUE_CELLS: Final = 14
_RIM_HEIGHT, _FLAT_HEIGHT = 0.014, 0.008
_ON_PLATE: Final = 0.055
"""A thing whose middle is no farther from the plate's stands on it."""
_MIDDLES: Final[Mapping[str, float]] = MappingProxyType({TEAPOT: 0.052, BOWL: 0.032, SPONGE: 0.022})
"""How high over what a thing stands on the middle is of what is seen of it."""
_HAND: Final = (0.36, 0.0, 0.28)
"""About where a held thing is."""
_HAND_REACH: Final = 85
"""Pixels around that; nothing on the table is so near."""
_TEA_PIXELS: Final = 30


@dataclass(frozen=True)
class _View:
    """A picture, sorted by materials.

    Attributes:
        seen: where each material is (rows, columns).
        camera: that took it.
    """

    seen: Mapping[str, Mask]
    camera: str

    def place_of(self, point: tuple[float, float, float]) -> tuple[float, float]:
        """Column and row of a point."""
        column, row = CAMERAS[self.camera].project(point, WIDTH, HEIGHT)
        return float(column), float(row)


def read_panda_scene(png: bytes) -> SceneGraph:
    """What a picture of the table shows.

    Kinds of things: ``robot``, ``item`` (teapot, bowl, sponge), ``vessel`` (mug), ``dish`` (plate).
    Relations: ``on`` (an item on the plate) and ``held``. Attributes: ``full`` of the mug,
    ``dirty`` of the plate.

    Args:
        png: the encoded picture, of one of the known cameras.

    Raises:
        PictureError: if it is no picture, or shows no such table.
    """
    seen = materials(decode_pixels(png, WIDTH, HEIGHT))
    camera = camera_of(seen[WOOD], CAMERAS)
    if camera is None:
        raise PictureError("expected a picture of the table with the arm, found no such table")
    view = _View(seen, camera)
    plate = _find_plate(view)
    things = [Thing(ROBOT, "robot", Box(0, 0, WIDTH, HEIGHT // 3))]
    relations: dict[str, set[tuple[str, str]]] = {"on": set(), "held": set()}
    attributes: dict[str, dict[str, bool]] = {}
    for name in PICKUPABLE:
        if seen[name].sum() >= _FEWEST:
            things.append(Thing(name, "item", _box(seen[name])))
            if _is_held(view, name):
                relations["held"].add((name, ROBOT))
            elif plate is not None and _is_on(view, name, plate):
                relations["on"].add((name, PLATE))
    if plate is not None:
        things.append(Thing(PLATE, "dish", _box_around(view, plate)))
        attributes[PLATE] = {"dirty": _is_dirty(view, plate)}
    if seen[MUG].sum() >= _FEWEST:
        things.append(Thing(MUG, "vessel", _box(seen[MUG])))
        attributes[MUG] = {"full": _is_full(view)}
    return SceneGraph(
        things=tuple(things),
        relations={name: frozenset(pairs) for name, pairs in relations.items()},
        attributes=attributes,
    )


def _find_plate(view: _View) -> tuple[float, float] | None:
    """The middle of the white disc on the table; things on it and before it hide parts of it."""
    white = seen_from_above(view.seen[PORCELAIN], view.camera, _RIM_HEIGHT)
    wood = seen_from_above(view.seen[WOOD], view.camera, _RIM_HEIGHT)
    place, share = best_disc(white, wood, _PLATE_RADIUS)
    return place if share > _PLATE_SHARE else None


def _middle(mask: Mask) -> tuple[float, float]:
    rows, columns = np.nonzero(mask)
    return float(columns.mean()), float(rows.mean())


def _is_held(view: _View, name: str) -> bool:
    column, row = _middle(view.seen[name])
    hand_column, hand_row = view.place_of(_HAND)
    return float(np.hypot(column - hand_column, row - hand_row)) < _HAND_REACH


def _is_on(view: _View, name: str, plate: tuple[float, float]) -> bool:
    column, row = _middle(view.seen[name])
    height = _FLAT_HEIGHT + _MIDDLES[name]
    x, y = CAMERAS[view.camera].on_plane(column, row, WIDTH, HEIGHT, height)
    return float(np.hypot(x - plate[0], y - plate[1])) < _ON_PLATE


def _is_dirty(view: _View, plate: tuple[float, float]) -> bool:
    """Whether brown is seen on the flat part of the plate, away from the mug and what is in it."""
    brown = view.seen[BROWN].copy()
    if view.seen[MUG].sum() >= _FEWEST:
        mug = _box(view.seen[MUG])
        brown[max(0, mug.top - 2) : mug.bottom + 2, max(0, mug.left - 2) : mug.right + 2] = False
    found = seen_from_above(brown, view.camera, _FLAT_HEIGHT) & around(plate, _FLAT_PART)
    return int(found.sum()) > _RESIDUE_CELLS


def _is_full(view: _View) -> bool:
    """Whether brown is seen in the mug's upper half, with the mug's red on all sides of it."""
    red, brown = view.seen[MUG], view.seen[BROWN]
    box = _box(red)
    part = np.s_[box.top : (box.top + box.bottom) // 2, box.left : box.right]
    whole = red[box.top : box.bottom, box.left : box.right]
    half = red[part].shape[0]
    left = np.maximum.accumulate(whole, axis=1)[:half]
    right = np.maximum.accumulate(whole[:, ::-1], axis=1)[:half, ::-1]
    above = np.maximum.accumulate(whole, axis=0)[:half]
    below = np.maximum.accumulate(whole[::-1], axis=0)[::-1][:half]
    return int((brown[part] & left & right & above & below).sum()) > _TEA_PIXELS


def _box(mask: Mask) -> Box:
    rows, columns = np.nonzero(mask)
    return Box(int(columns.min()), int(rows.min()), int(columns.max()) + 1, int(rows.max()) + 1)


def _box_around(view: _View, plate: tuple[float, float]) -> Box:
    angles = np.linspace(0, 2 * np.pi, 16)
    edge = [
        (plate[0] + _PLATE_RADIUS * np.cos(a), plate[1] + _PLATE_RADIUS * np.sin(a), _RIM_HEIGHT)
        for a in angles
    ]
    columns, rows = CAMERAS[view.camera].project(edge, WIDTH, HEIGHT)
    return Box(int(columns.min()), int(rows.min()), int(columns.max()), int(rows.max()))

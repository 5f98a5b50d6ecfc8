"""Reading pictures of the two arms' table: pixels in, a scene graph out.

It knows the colours of the things, where cameras stand and where hands wait, as whoever sets them
up does, and nothing of the simulator's state.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from skillwrapper.domains.kuka.cameras import CAMERAS
from skillwrapper.domains.kuka.colours import (
    BUTTER,
    CRUMB,
    HANDLE,
    HOLDER,
    LID,
    TABLE,
    materials,
)
from skillwrapper.domains.kuka.states import BREAD, JAR, KNIFE, ROBOT
from skillwrapper.domains.tabletop.cameras import HEIGHT, WIDTH
from skillwrapper.domains.tabletop.colours import Mask
from skillwrapper.domains.tabletop.poses import Vector
from skillwrapper.domains.tabletop.views import camera_of
from skillwrapper.embedded.pixels import decode_pixels
from skillwrapper.embedded.scene_graph import Box, SceneGraph, Thing
from skillwrapper.errors import PictureError

_FEWEST: Final = 150
"""So many pixels of a colour are a thing and no accident."""
_MOST: Final = 4000
"""Nothing on the table is larger."""
_LEFT_HAND: Final = (0.48, 0.40, 0.22)
_RIGHT_HAND: Final = (0.45, -0.42, 0.23)
"""Where the hands wait, and what they hold with them."""
_LEFT_REACH, _RIGHT_REACH = 0.12, 0.12
"""What is seen no farther from there is held, in metres at that place."""
_IN_HOLDER: Final = 0.14
"""The middle of a handle that stands in the holder is so near to the holder's, likewise."""
_ON_JAR: Final = 0.07
"""A lid on a jar has butter so near to its middle, likewise; one on the table has none."""
_ENOUGH_BUTTER: Final = 25
_BLADE: Final = (0.045, 0.200)
"""From where to where the blade is, from the middle of the handle."""
_BLADE_WIDTH: Final = 0.026
"""Half of it."""
_TRACES, _COAT = 0.03, 0.22
"""Shares of the blade under peanut butter from which it is smeared, and coated."""
_SLICE, _HEART = 0.09, 0.04
"""No part of the bread is farther from its middle; what is so near is all crumb, in metres."""
_TOPPING: Final = 0.20
"""Share of that under peanut butter from which bread is spread."""


@dataclass(frozen=True)
class _View:
    """A picture, sorted by materials.

    Attributes:
        seen: where each material is (rows, columns).
        camera: that took it.
    """

    seen: Mapping[str, Mask]
    camera: str

    def place_of(self, point: tuple[float, float, float]) -> Vector:
        """Column and row (2,) of a point."""
        return np.array(CAMERAS[self.camera].project(point, WIDTH, HEIGHT), float)

    def pixels(self, metres: float) -> float:
        """How many pixels a length has over the middle of the table."""
        camera = CAMERAS[self.camera]
        away = float(np.linalg.norm(np.subtract(camera.target, camera.position)))
        scale = HEIGHT / 2 / float(np.tan(np.radians(camera.field_of_view) / 2))
        return metres * scale / away

    def near(self, material: str, place: Vector, metres: float) -> Mask:
        """Where a material is seen no farther from a place (2,) in the picture."""
        rows, columns = np.ogrid[:HEIGHT, :WIDTH]
        squared = (columns - place[0]) ** 2 + (rows - place[1]) ** 2
        return np.asarray(self.seen[material] & (squared < self.pixels(metres) ** 2))


def read_kuka_scene(png: bytes) -> SceneGraph:
    """What a picture of the two arms' table shows.

    Kinds of things: ``robot``, ``vessel`` (jar), ``utensil`` (knife), ``food`` (bread); a
    ``holder`` as scenery. Relations: ``held`` and ``in`` (the knife in the holder). Attributes:
    ``open`` of the jar, ``coated`` and ``smeared`` (with much or with any peanut butter) of the
    knife, ``spread`` of the bread, ``left_hand_full`` and
    ``right_hand_full`` of the robot.

    Args:
        png: the encoded picture, of one of the known cameras.

    Raises:
        PictureError: if it is no picture, or shows no such table.
    """
    seen = materials(decode_pixels(png, WIDTH, HEIGHT))
    camera = camera_of(seen[TABLE], CAMERAS)
    sizes = [int(seen[name].sum()) for name in (HOLDER, LID, CRUMB)]
    if camera is None or min(sizes) < _FEWEST or max(sizes) > _MOST:
        raise PictureError("expected a picture of the table with two arms, found no such table")
    view = _View(seen, camera)
    things = [
        Thing(ROBOT, "robot", Box(0, 3 * HEIGHT // 4, WIDTH, HEIGHT)),
        Thing(HOLDER, "holder", _box(seen[HOLDER]), scenery=True),
    ]
    relations: dict[str, set[tuple[str, str]]] = {"held": set(), "in": set()}
    hands = {"left_hand_full": False, "right_hand_full": False}
    attributes: dict[str, dict[str, bool]] = {ROBOT: hands}
    jar = _find_jar(view)
    if jar is not None:
        things.append(Thing(JAR, "vessel", _box(jar)))
        attributes[JAR] = {"open": not (jar & seen[LID]).any()}
        if _is_held(view, jar, _LEFT_HAND, _LEFT_REACH):
            relations["held"].add((JAR, ROBOT))
            hands["left_hand_full"] = True
    if seen[HANDLE].sum() >= _FEWEST:
        blade = _blade(view)
        things.append(Thing(KNIFE, "utensil", _box(seen[HANDLE] | (blade & seen[BUTTER]))))
        attributes[KNIFE] = _looks_of_blade(view, blade)
        if _is_held(view, seen[HANDLE], _RIGHT_HAND, _RIGHT_REACH):
            relations["held"].add((KNIFE, ROBOT))
            hands["right_hand_full"] = True
        elif _is_in_holder(view):
            relations["in"].add((KNIFE, HOLDER))
    bread = view.near(CRUMB, _median(seen[CRUMB]), _SLICE)
    things.append(Thing(BREAD, "food", _box(bread)))
    attributes[BREAD] = {"spread": _is_spread(view, bread)}
    return SceneGraph(
        things=tuple(things),
        relations={name: frozenset(pairs) for name, pairs in relations.items()},
        attributes=attributes,
    )


def _find_jar(view: _View) -> Mask | None:
    """The lid with the butter under it; or butter in the left hand."""
    lid = view.seen[LID]
    butter = view.near(BUTTER, _middle(lid), _ON_JAR)
    if butter.sum() >= _ENOUGH_BUTTER:
        return np.asarray(lid | butter)
    held = view.near(BUTTER, view.place_of(_LEFT_HAND), _LEFT_REACH)
    return held if held.sum() >= _FEWEST else None


def _is_held(view: _View, mask: Mask, hand: tuple[float, float, float], reach: float) -> bool:
    return bool(np.linalg.norm(_middle(mask) - view.place_of(hand)) < view.pixels(reach))


def _is_in_holder(view: _View) -> bool:
    """Whether the handle stands upright over the holder."""
    apart = _middle(view.seen[HANDLE]) - _middle(view.seen[HOLDER])
    right, down = np.abs(_axis(view.seen[HANDLE]))
    is_near = float(np.linalg.norm(apart)) < view.pixels(_IN_HOLDER)
    return bool(is_near and apart[1] < 0 and down > right)


def _blade(view: _View) -> Mask:
    """Where a blade would be at either end of the handle."""
    middle, axis = _middle(view.seen[HANDLE]), _axis(view.seen[HANDLE])
    rows, columns = np.ogrid[:HEIGHT, :WIDTH]
    x, y = columns - middle[0], rows - middle[1]
    along, across = np.abs(axis[0] * x + axis[1] * y), np.abs(axis[0] * y - axis[1] * x)
    start, end = (view.pixels(length) for length in _BLADE)
    return np.asarray((along > start) & (along < end) & (across < view.pixels(_BLADE_WIDTH)))


def _looks_of_blade(view: _View, blade: Mask) -> dict[str, bool]:
    share = 2 * float((view.seen[BUTTER] & blade).sum() / max(1, blade.sum()))
    return {"coated": share > _COAT, "smeared": share > _TRACES}


def _is_spread(view: _View, crumb: Mask) -> bool:
    """Whether there is peanut butter on the middle of the bread."""
    middle = _middle(crumb)
    butter = int(view.near(BUTTER, middle, _HEART).sum())
    return butter > _TOPPING * (butter + int(view.near(CRUMB, middle, _HEART).sum()))


def _axis(mask: Mask) -> Vector:
    """Direction (columns, rows) in which something is longest, of length 1."""
    rows, columns = np.nonzero(mask)
    offsets = np.stack([columns - columns.mean(), rows - rows.mean()], axis=-1)
    return np.asarray(np.linalg.eigh(offsets.T @ offsets)[1][:, 1])


def _median(mask: Mask) -> Vector:
    """Column and row (2,)."""
    rows, columns = np.nonzero(mask)
    return np.array([np.median(columns), np.median(rows)])


def _middle(mask: Mask) -> Vector:
    """Column and row (2,)."""
    rows, columns = np.nonzero(mask)
    return np.array([columns.mean(), rows.mean()])


def _box(mask: Mask) -> Box:
    rows, columns = np.nonzero(mask)
    return Box(int(columns.min()), int(rows.min()), int(columns.max()) + 1, int(rows.max()) + 1)

"""Reading pictures of the burger kitchen: pixels in, a scene graph out.

It knows the colours and shapes of the usual drawing and nothing of the simulator.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Final

import numpy as np

from skillwrapper.embedded.pixels import (
    ColourTable,
    Counts,
    Pixels,
    Raster,
    Rgb,
    box_around,
    decode_pixels,
    find_patches,
    middle_of,
)
from skillwrapper.embedded.scene_graph import Box, SceneGraph, Thing
from skillwrapper.errors import PictureError

_SIZE: Final = 512
_STEP: Final = 2
"""Every second row and column is looked at."""
_BLOCK: Final = 4
"""Width and height, in rows and columns looked at, of the blocks in which colours are counted."""
_FURNITURE_PIXELS: Final = 150
_ITEM_PIXELS: Final = 60
_STACK_REACH: Final = 96
"""How far above furniture, or above the robot's head, an item's middle can be, in pixels."""
_FLOOR: Final = np.array((238, 233, 225))
"""What the floor looks like in good light."""

_COLOURS: Final[Mapping[str, tuple[Rgb, ...]]] = MappingProxyType(
    {
        "nothing": (
            (243, 239, 232), (222, 215, 203), (190, 201, 208), (150, 163, 174), (58, 48, 66),
            (44, 38, 72), (126, 240, 250), (150, 158, 168), (200, 192, 182), (140, 134, 136),
        ),
        "wood": ((218, 184, 152), (198, 156, 122), (150, 108, 82)),
        "fire": ((255, 104, 58), (190, 52, 36), (255, 214, 110)),
        "table": ((186, 216, 240), (158, 196, 228), (112, 154, 196)),
        "stove": ((116, 120, 130), (84, 88, 98), (58, 61, 70)),
        "board": ((92, 178, 178), (42, 132, 138), (26, 100, 108)),
        "robot": ((172, 152, 236), (132, 108, 212), (94, 74, 170)),
        "whole lettuce": ((126, 194, 70), (88, 164, 50), (54, 122, 38)),
        "cut lettuce": ((236, 248, 192), (210, 236, 146), (174, 214, 110)),
        "raw patty": ((252, 186, 190), (240, 134, 144), (212, 98, 114)),
        "cooked patty": ((132, 80, 50), (104, 58, 36), (52, 28, 20)),
        "topbun": ((240, 176, 100), (216, 126, 44), (174, 92, 30)),
        "bottombun": ((255, 242, 190), (247, 200, 92), (226, 168, 60)),
    }
)  # fmt: skip


@dataclass(frozen=True)
class _Look:
    """How an item looks as it is at first, and how it may look later.

    Attributes:
        plain: group of colours at first.
        changed: group of colours later, may be empty.
        attribute: what it then is.
    """

    plain: str
    changed: str = ""
    attribute: str = ""


_ITEMS: Final[Mapping[str, _Look]] = MappingProxyType(
    {
        "lettuce": _Look("whole lettuce", "cut lettuce", "cut"),
        "patty": _Look("raw patty", "cooked patty", "cooked"),
        "topbun": _Look("topbun"),
        "bottombun": _Look("bottombun"),
    }
)


def read_burger_scene(png: bytes) -> SceneGraph:
    """What a picture of the burger kitchen shows.

    Kinds of things: ``robot``, ``station`` (stove, board), ``item`` (lettuce, patty, topbun,
    bottombun), and ``table`` (table_1, ...), which is scenery. Relations: ``on`` and ``held``.
    Attributes: ``cut`` of the lettuce, ``cooked`` of the patty.

    Args:
        png: the encoded picture, in the usual drawing; any arrangement of the kitchen.

    Raises:
        PictureError: if it is no picture, or shows no burger kitchen.
    """
    pixels = _in_good_light(decode_pixels(png, _SIZE, _SIZE)[::_STEP, ::_STEP])
    raster = _colour_table().raster(pixels, _BLOCK)
    places = _find_places(raster)
    seen = [item for name in _ITEMS if (item := _find_item(raster, name)) is not None]
    on, held = _relate(seen, places)
    return SceneGraph(
        things=(*places, *(item.thing for item in seen)),
        relations={"on": frozenset(on), "held": frozenset(held)},
        attributes={item.thing.name: item.attributes for item in seen if item.attributes},
    )


@dataclass(frozen=True)
class _SeenItem:
    """An item with the middle of what is visible of it (column, row), in pixels."""

    thing: Thing
    middle: tuple[float, float]
    attributes: Mapping[str, bool]


@cache
def _colour_table() -> ColourTable:
    return ColourTable(_COLOURS)


def _in_good_light(pixels: Pixels) -> Pixels:
    """The pixels as they would be if the floor, most of every picture, had its usual colour."""
    floor = np.median(pixels[::8, ::8].reshape(-1, 3), axis=0)
    if np.abs(floor - _FLOOR).max() <= 8:
        return pixels
    gain = _FLOOR / np.maximum(floor, 1)
    corrected = np.clip(np.arange(256)[:, np.newaxis] * gain, 0, 255).astype(np.uint8)
    return np.stack([corrected[pixels[..., c], c] for c in range(3)], axis=-1)


def _find_places(raster: Raster) -> tuple[Thing, ...]:
    """Robot, stations and tables."""
    found = {
        kind: [
            _in_picture(patch.box)
            for patch in find_patches(raster.dense_amount(0.5, kind))
            if patch.pixels >= _FURNITURE_PIXELS
        ]
        for kind in ("robot", "stove", "board", "table")
    }
    missing = [kind for kind, boxes in found.items() if not boxes]
    if missing:
        raise PictureError(
            f"expected a picture of the burger kitchen, found no {' and no '.join(missing)}"
        )
    tables = sorted(found["table"], key=lambda box: (box.bottom * 3 // _SIZE, box.left))
    return (
        Thing("robot", "robot", _around(found["robot"])),
        Thing("stove", "station", _around(found["stove"])),
        Thing("board", "station", _around(found["board"])),
        *(Thing(f"table_{n}", "table", box, scenery=True) for n, box in enumerate(tables, start=1)),
    )


def _find_item(raster: Raster, name: str) -> _SeenItem | None:
    look = _ITEMS[name]
    groups = [group for group in (look.plain, look.changed) if group]
    amount = raster.dense_amount(0.4, *groups)
    if amount.sum() < _ITEM_PIXELS:
        return None
    changed = bool(look.changed) and _mostly(look.changed, amount, raster)
    column, row = middle_of(amount)
    return _SeenItem(
        Thing(name, "item", _in_picture(box_around(amount))),
        (column * _BLOCK * _STEP, row * _BLOCK * _STEP),
        {look.attribute: changed} if look.attribute else {},
    )


def _mostly(group: str, amount: Counts, raster: Raster) -> bool:
    """Whether more than half of the amount (rows, columns) is of a group of colours."""
    return 2 * int(raster.amount(group)[amount > 0].sum()) > int(amount.sum())


def _relate(
    items: list[_SeenItem], places: tuple[Thing, ...]
) -> tuple[set[tuple[str, str]], set[tuple[str, str]]]:
    """What each item is directly on, and who holds what."""
    on: set[tuple[str, str]] = set()
    held: set[tuple[str, str]] = set()
    for place in places:
        stack = [item for item in items if _is_at(item, place)]
        below = place.name
        for item in sorted(stack, key=lambda item: -item.middle[1]):
            target = held if place.kind == "robot" and below == place.name else on
            target.add((item.thing.name, below))
            below = item.thing.name
    return on, held


def _is_at(item: _SeenItem, place: Thing) -> bool:
    column, row = item.middle
    box = place.box
    return box.left <= column < box.right and box.top - _STACK_REACH <= row < box.bottom


def _around(boxes: list[Box]) -> Box:
    return Box(
        min(box.left for box in boxes),
        min(box.top for box in boxes),
        max(box.right for box in boxes),
        max(box.bottom for box in boxes),
    )


def _in_picture(box: Box) -> Box:
    """A box in blocks, in pixels of the picture."""
    scale = _BLOCK * _STEP
    return Box(box.left * scale, box.top * scale, box.right * scale, box.bottom * scale)

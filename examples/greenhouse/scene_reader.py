"""What the embedded model sees in a picture of the greenhouse: pixels in, a scene graph out.

A hosted model needs no such file: it looks for itself. The embedded model can only name what a
scene reader finds, and a reader for drawings is a matter of colours. It must never ask the
simulator: then nothing that is learned would say anything about learning from pictures.
"""

from __future__ import annotations

import io
from collections.abc import Mapping

import looks
import numpy as np
import numpy.typing as npt
from PIL import Image

from skillwrapper.embedded import Box, SceneGraph, Thing
from skillwrapper.errors import PictureError

Pixels = npt.NDArray[np.int32]

_CHANNELS = np.array([1 << 16, 1 << 8, 1], dtype=np.int32)
"""Makes one number of red, green and blue."""
_FEWEST = 25
"""So many pixels of a colour are a thing and no accident."""


def read_greenhouse(png: bytes) -> SceneGraph:
    """What is where in a picture.

    Kinds of things: ``robot``, ``pot``, ``bell``. Relations: ``on`` (a bell over a pot) and
    ``held``. Attributes of pots: ``wet``, ``trimmed``. All of these are named for every picture,
    whether they are the case or not: what is never named cannot be asked about.

    Args:
        png: the encoded picture.

    Raises:
        PictureError: if it is no picture, or one of something else.
    """
    pixels = _decode(png)
    robot = _find(pixels, looks.ROBOT)
    if robot is None:
        raise PictureError("expected a picture of the greenhouse, found no robot in it")
    gardener = Thing("gardener", "robot", robot)
    pots = _things(pixels, "pot", looks.POTS)
    bells = _things(pixels, "bell", looks.KNOBS)
    held = {(bell.name, gardener.name) for bell in bells if _is_over(bell, gardener)}
    on = {(bell.name, pot.name) for bell in bells for pot in pots if _is_over(bell, pot)}
    return SceneGraph(
        things=(gardener, *pots, *bells),
        relations={"held": held, "on": on},
        attributes={pot.name: _look_of(pixels, pot) for pot in pots},
    )


def _decode(png: bytes) -> Pixels:
    """The colour of every pixel as one number (rows, columns)."""
    try:
        image = Image.open(io.BytesIO(png)).convert("RGB")
    except OSError as error:
        raise PictureError("expected the bytes of a picture, got something else") from error
    if image.size != looks.SIZE:
        raise PictureError(f"expected a picture of {looks.SIZE} pixels, got {image.size}")
    return np.asarray(image).astype(np.int32) @ _CHANNELS


def _things(pixels: Pixels, kind: str, colours: Mapping[str, looks.Colour]) -> tuple[Thing, ...]:
    boxes = {name: _find(pixels, colour) for name, colour in colours.items()}
    return tuple(Thing(name, kind, box) for name, box in boxes.items() if box is not None)


def _find(pixels: Pixels, colour: looks.Colour) -> Box | None:
    """The box around all pixels of a colour; None if there are too few of them."""
    rows, columns = np.nonzero(pixels == np.dot(colour, _CHANNELS))
    if len(rows) < _FEWEST:
        return None
    left, top, right, bottom = columns.min(), rows.min(), columns.max() + 1, rows.max() + 1
    return Box(int(left), int(top), int(right), int(bottom))


def _shows(pixels: Pixels, colour: looks.Colour) -> bool:
    """Whether a colour is seen anywhere."""
    return _find(pixels, colour) is not None


def _is_over(bell: Thing, other: Thing) -> bool:
    """Whether the knob of a bell is above a pot or the robot."""
    return other.box.left <= bell.box.centre[0] < other.box.right


def _look_of(pixels: Pixels, pot: Thing) -> dict[str, bool]:
    """Whether the soil of a pot is wet, and its plant trimmed."""
    column = pixels[:, pot.box.left : pot.box.right]
    return {
        "wet": _shows(column, looks.WET_SOIL),
        "trimmed": not _shows(column, looks.SHOOT),
    }

"""Floor and wall of the kitchen."""

from __future__ import annotations

from PIL import Image, ImageDraw

from skillwrapper.domains.burger.layout import PICTURE_SIZE
from skillwrapper.domains.burger.style import Style

_WALL_HEIGHT = 18
_TILE = 64


def draw_backdrop(style: Style) -> Image.Image:
    """A tiled floor below a strip of wall, in RGB."""
    image = Image.new("RGB", (PICTURE_SIZE, PICTURE_SIZE), style.floor.dark)
    draw = ImageDraw.Draw(image)
    for row in range(-1, PICTURE_SIZE // _TILE + 1):
        for column in range(PICTURE_SIZE // _TILE):
            left, top = column * _TILE, _WALL_HEIGHT + row * _TILE
            tone = style.floor.light if (row + column) % 2 else style.floor.base
            draw.rectangle((left, top, left + _TILE - 2, top + _TILE - 2), tone)
    draw.rectangle((0, 0, PICTURE_SIZE, _WALL_HEIGHT - 1), style.wall.base)
    draw.rectangle((0, 0, PICTURE_SIZE, _WALL_HEIGHT - 7), style.wall.light)
    draw.rectangle((0, _WALL_HEIGHT - 2, PICTURE_SIZE, _WALL_HEIGHT - 1), style.wall.dark)
    return image

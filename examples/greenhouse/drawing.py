"""Drawing the greenhouse with Pillow."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import TYPE_CHECKING

import looks
from PIL import Image, ImageDraw

if TYPE_CHECKING:
    from greenhouse import State

_GROUND = 210
"""Row on which everything stands."""
_ROBOT_TOP = 130
_COLUMN = 90
"""Pixels from the middle of one thing to that of the next."""


def draw_greenhouse(present: Sequence[str], state: State, layout: int) -> Image.Image:
    """The picture of a state.

    Args:
        present: names of what is there.
        state: how things are.
        layout: mixes up who stands where. That is never what matters; that it differs from
            episode to episode keeps a model from taking "left of the red pot" for the reason why
            something works.
    """
    columns = _arrange([name for name in present if name not in looks.KNOBS], layout)
    image = Image.new("RGB", looks.SIZE, looks.WALL)
    pen = ImageDraw.Draw(image)
    _draw_room(pen)
    _draw_robot(pen, columns["gardener"])
    for pot in sorted(looks.POTS.keys() & columns.keys()):
        _draw_pot(pen, columns[pot], looks.POTS[pot], pot in state.wet, pot in state.trimmed)
    for pot, bell in sorted(state.covered):
        _draw_bell(pen, columns[pot], _GROUND, looks.KNOBS[bell])
    for bell in present:
        if bell in looks.KNOBS and state.is_held(bell):
            _draw_bell(pen, columns["gardener"], _ROBOT_TOP - 8, looks.KNOBS[bell])
    return image


def _arrange(names: list[str], layout: int) -> dict[str, int]:
    """The column in which the middle of each thing is."""
    chance = random.Random(layout)
    chance.shuffle(names)
    return {n: 65 + _COLUMN * k + chance.randint(-12, 12) for k, n in enumerate(names)}


def _draw_room(pen: ImageDraw.ImageDraw) -> None:
    width, height = looks.SIZE
    for x in range(0, width, 80):
        pen.rectangle((x + 4, 8, x + 76, _GROUND - 30), fill=looks.PANE)
    pen.rectangle((0, _GROUND - 6, width, height), fill=looks.BENCH)
    pen.rectangle((0, _GROUND + 22, width, height), fill=looks.BENCH_FRONT)


def _draw_pot(
    pen: ImageDraw.ImageDraw, x: int, colour: looks.Colour, wet: bool, trimmed: bool
) -> None:
    top = _GROUND - 34
    for lean, height in ((-14, 18), (0, 26), (14, 18)):
        pen.line((x, top, x + lean, top - height), fill=looks.LEAF, width=7)
    if not trimmed:
        for lean in (-20, 20):
            pen.line((x, top - 14, x + lean, top - 34), fill=looks.SHOOT, width=5)
    pen.polygon([(x - 24, top), (x + 24, top), (x + 17, _GROUND), (x - 17, _GROUND)], fill=colour)
    pen.rectangle((x - 20, top, x + 20, top + 7), fill=looks.WET_SOIL if wet else looks.DRY_SOIL)


def _draw_bell(pen: ImageDraw.ImageDraw, x: int, bottom: int, knob: looks.Colour) -> None:
    left, right, top = x - 32, x + 32, bottom - 88
    pen.arc((left, top, right, top + 64), 180, 360, fill=looks.GLASS, width=3)
    for side in (left + 1, right - 1):
        pen.line((side, top + 32, side, bottom), fill=looks.GLASS, width=3)
    pen.line((left, bottom, right, bottom), fill=looks.GLASS, width=3)
    pen.ellipse((x - 7, top - 12, x + 7, top + 2), fill=knob)


def _draw_robot(pen: ImageDraw.ImageDraw, x: int) -> None:
    pen.rounded_rectangle((x - 24, _ROBOT_TOP, x + 24, _GROUND - 8), 12, fill=looks.ROBOT)
    pen.rounded_rectangle((x - 17, _ROBOT_TOP + 10, x + 17, _ROBOT_TOP + 34), 8, fill=looks.FACE)
    for eye in (x - 8, x + 8):
        pen.ellipse((eye - 4, _ROBOT_TOP + 18, eye + 4, _ROBOT_TOP + 26), fill=looks.EYE)
    for wheel in (x - 14, x + 14):
        pen.ellipse((wheel - 9, _GROUND - 16, wheel + 9, _GROUND + 2), fill=looks.FACE)

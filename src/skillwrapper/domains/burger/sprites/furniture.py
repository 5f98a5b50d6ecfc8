"""Tables and stations. Their lower front edge stands on the anchor."""

from __future__ import annotations

from typing import Final

from skillwrapper.domains.burger.sprites.canvas import Canvas, Sprite
from skillwrapper.domains.burger.style import Style, Tones

SURFACE_HEIGHT: Final = 35
"""How far above the anchor an ingredient on a table or station stands, in pixels."""

_HALF_WIDTH: Final = 57.0
_TOP: Final = -76.0
_FRONT_EDGE: Final = -26.0


def draw_table(style: Style) -> Sprite:
    """A plain table with a cloth."""
    canvas = _furniture_canvas(style)
    tones = style.table
    for x in (-49, 41):
        canvas.outlined_box((x, -14), (x + 8, 0), tones.dark, 2)
    canvas.outlined_box((-_HALF_WIDTH, _TOP), (_HALF_WIDTH, -11), tones.dark, 9)
    canvas.box((-_HALF_WIDTH, _TOP), (_HALF_WIDTH, _FRONT_EDGE + 3), tones.base, 9)
    canvas.box((-_HALF_WIDTH + 5, _TOP + 5), (_HALF_WIDTH - 5, _FRONT_EDGE - 2), tones.light, 6)
    canvas.box((-_HALF_WIDTH + 8, _TOP + 8), (_HALF_WIDTH - 8, _FRONT_EDGE - 5), tones.base, 4)
    return canvas.finish()


def draw_stove(style: Style) -> Sprite:
    """A stove with one glowing burner and an oven window."""
    canvas = _furniture_canvas(style)
    steel, fire = style.stove, style.fire
    _cabinet(canvas, steel)
    canvas.ellipse((0, -49), (45, 20), steel.dark)
    canvas.ellipse((0, -49), (41, 17.5), fire.dark)
    canvas.ellipse((0, -49), (38, 16), fire.base)
    canvas.ellipse((0, -49), (29, 11.5), steel.dark)
    canvas.ellipse((0, -49), (20, 8), fire.base)
    canvas.ellipse((0, -49), (11, 4.2), fire.light)
    for x in (-47, 47):
        canvas.ellipse((x, -16), (3.6, 3.6), style.steel.base)
    canvas.box((-33, -20), (33, -4), style.outline, 4)
    canvas.box((-31, -18), (31, -6), fire.dark, 3)
    canvas.box((-31, -12), (31, -6), fire.base, 3)
    canvas.box((-24, -9), (24, -6), fire.light, 1)
    return canvas.finish()


def draw_board(style: Style) -> Sprite:
    """A cabinet with a wooden cutting board and a knife on top."""
    canvas = _furniture_canvas(style)
    tones, wood = style.board, style.wood
    _cabinet(canvas, tones)
    canvas.outlined_box((-45, -69), (35, -30), wood.dark, 7)
    canvas.box((-45, -69), (35, -33), wood.base, 7)
    for y in (-61, -53, -45, -38):
        canvas.line([(-41, y), (31, y)], wood.light, 1.6)
    canvas.ellipse((-39, -63), (3, 2.4), tones.base)
    canvas.polygon([(41, -71), (47, -64), (47, -48), (41, -48)], style.outline)
    canvas.polygon([(42.2, -68), (46, -63), (46, -49), (42.2, -49)], style.steel.base)
    canvas.box((40.5, -48), (47.5, -33), style.outline, 2)
    for left, right in ((-51, -3), (3, 51)):
        canvas.box((left, -20), (right, -4), tones.dark, 3)
        canvas.box((left + 2, -18), (right - 2, -6), tones.base, 2)
    for x in (-9, 9):
        canvas.ellipse((x, -12), (2.4, 2.4), style.steel.light)
    return canvas.finish()


def _furniture_canvas(style: Style) -> Canvas:
    canvas = Canvas(style, left=68, up=84, right=68, down=8)
    canvas.shadow((0, -3), (64, 9))
    return canvas


def _cabinet(canvas: Canvas, tones: Tones) -> None:
    """A box on the floor, seen from the front and above."""
    canvas.outlined_box((-_HALF_WIDTH, _TOP), (_HALF_WIDTH, 0), tones.base, 7)
    canvas.box((-_HALF_WIDTH, _TOP), (_HALF_WIDTH, _FRONT_EDGE + 2), tones.light, 7)
    canvas.box((-_HALF_WIDTH, _FRONT_EDGE - 2), (_HALF_WIDTH, _FRONT_EDGE + 2), tones.dark)

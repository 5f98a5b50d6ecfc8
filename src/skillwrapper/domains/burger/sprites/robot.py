"""The robot, with its arms down or up. Its feet stand on the anchor."""

from __future__ import annotations

from typing import Final

from skillwrapper.domains.burger.sprites.canvas import Canvas, Sprite
from skillwrapper.domains.burger.style import Style

HAND_HEIGHT: Final = 102
"""How far above the anchor a held ingredient floats, in pixels."""


def draw_robot(style: Style, *, carrying: bool) -> Sprite:
    """A round, friendly robot; it lifts its arms to what it carries."""
    canvas = Canvas(style, left=52, up=116, right=52, down=8)
    canvas.shadow((0, -3), (40, 9))
    _draw_arms(canvas, carrying=carrying)
    _draw_body(canvas)
    _draw_head(canvas, antenna=not carrying)
    return canvas.finish()


def _draw_arms(canvas: Canvas, *, carrying: bool) -> None:
    style = canvas.style
    for side in (-1, 1):
        low = [(side * 24.0, -30.0), (side * 36.0, -24.0), (side * 38.0, -14.0)]
        high = [(side * 24.0, -30.0), (side * 43.0, -44.0), (side * 40.0, -94.0)]
        path = high if carrying else low
        canvas.line(path, style.outline, 10 + 2 * style.outline_width)
        canvas.line(path, style.robot.dark, 10)
        canvas.outlined_ellipse(path[-1], (7, 7), style.robot.light)


def _draw_body(canvas: Canvas) -> None:
    style = canvas.style
    for x in (-16, 16):
        canvas.outlined_ellipse((x, -5), (12, 6), style.robot.dark)
    canvas.outlined_box((-28, -44), (28, -7), style.robot.base, 16)
    canvas.box((-28, -18), (28, -7), style.robot.dark, 11)
    canvas.box((-28, -30), (28, -14), style.robot.base, 6)
    canvas.box((-12, -36), (12, -20), style.robot.light, 5)
    for x in (-6, 0, 6):
        canvas.ellipse((x, -28), (1.9, 1.9), style.robot.dark)


def _draw_head(canvas: Canvas, *, antenna: bool) -> None:
    style = canvas.style
    if antenna:
        canvas.line([(0, -84), (0, -100)], style.outline, 3.2)
        canvas.outlined_ellipse((0, -103), (5.5, 5.5), style.face.light)
    for x in (-35, 35):
        canvas.outlined_box((x - 5, -72), (x + 5, -54), style.robot.dark, 4)
    canvas.outlined_box((-34, -88), (34, -42), style.robot.base, 17)
    canvas.box((-26, -86), (26, -80), style.robot.light, 3)
    canvas.outlined_box((-26, -78), (26, -50), style.face.base, 11)
    for x in (-12, 12):
        canvas.ellipse((x, -66), (5, 6.2), style.face.light)
        canvas.ellipse((x + 1.6, -68.4), (1.6, 2.0), style.steel.light)
    canvas.arc((0, -62), (7, 6.5), (20, 160), style.face.light, 2.0)

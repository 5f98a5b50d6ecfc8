"""The ingredients, drawn so that their lower half alone tells what they are.

In a stack each ingredient hides all but the lowest ``LEVEL_HEIGHT`` pixels of the one beneath.
"""

from __future__ import annotations

import math
import random
from typing import Final

from skillwrapper.domains.burger.sprites.canvas import Canvas, Point, Sprite
from skillwrapper.domains.burger.style import Style, Tones

LEVEL_HEIGHT: Final = 24
"""How much higher the next ingredient of a stack lies, in pixels."""

_RADII: Final = (36.0, 12.0)
_LEAVES: Final = 11
_SHREDS: Final = 120


def draw_lettuce(style: Style) -> Sprite:
    """A whole head of lettuce: a ball of leaves with a wavy edge."""
    canvas = _food_canvas(style)
    tones = style.lettuce
    for radius, colour in ((38.0 + style.outline_width, style.outline), (38.0, tones.dark)):
        canvas.polygon(_wavy(radius, 23.0 * radius / 38.0, -23.5, 1.6), colour)
    canvas.polygon(_wavy(33.5, 20.0, -24.5, 1.5), tones.base)
    canvas.polygon(_wavy(22.0, 14.5, -28.0, 1.2), tones.light)
    canvas.polygon(_wavy(16.5, 10.5, -27.0, 1.0), tones.base)
    for side in (-1, 1):
        inner, outer = ((3, -4), (9, -14), (13, -24)), ((13, -5), (22, -13), (28, -22))
        canvas.line([(side * x, y) for x, y in inner], tones.light, 1.8)
        canvas.line([(side * x, y) for x, y in outer], tones.dark, 1.8)
        canvas.line([(side * 2, -22), (side * 8, -30)], tones.dark, 1.6)
    canvas.line([(0.0, -2.5), (0.0, -16.0)], tones.light, 2.0)
    return canvas.finish()


def draw_shreds(style: Style) -> Sprite:
    """Cut lettuce: a flat heap of pale shreds."""
    canvas = _food_canvas(style)
    tones = style.shreds
    for radius, colour in ((37.0 + style.outline_width, style.outline), (37.0, tones.dark)):
        canvas.polygon(_wavy(radius, 16.5 * radius / 37.0, -16.5, 2.2), colour)
    canvas.polygon(_wavy(34.0, 14.5, -17.0, 2.0), tones.base)
    chance = random.Random("shreds")
    colours = (tones.base, tones.light, tones.dark, tones.light)
    for number in range(_SHREDS):
        angle, distance = chance.uniform(0, math.tau), math.sqrt(chance.random())
        x, y = 30.0 * distance * math.cos(angle), -17.0 + 11.5 * distance * math.sin(angle)
        dx, dy = chance.uniform(-6, 6), chance.uniform(-3, 3)
        canvas.line([(x - dx, y - dy), (x, y - 1.5), (x + dx, y + dy)], colours[number % 4], 2.0)
    return canvas.finish()


def draw_raw_patty(style: Style) -> Sprite:
    """A raw patty: pink with pale flecks."""
    canvas = _food_canvas(style)
    canvas.shadow((0, -11), (39, 13))
    canvas.disc(_RADII, LEVEL_HEIGHT - 2, style.raw)
    _rim(canvas, style.raw)
    chance = random.Random("raw patty")
    for _ in range(26):
        angle, distance = chance.uniform(0, math.tau), math.sqrt(chance.random())
        centre = 31.0 * distance * math.cos(angle), -34.0 + 9.0 * distance * math.sin(angle)
        canvas.ellipse(centre, (chance.uniform(1.4, 2.8), 1.2), style.raw.base)
    for x, y in ((-26, -18), (-14, -11), (-3, -17), (10, -9), (19, -16), (28, -13)):
        canvas.ellipse((x, y), (2.6, 1.7), style.raw.light)
    return canvas.finish()


def draw_cooked_patty(style: Style) -> Sprite:
    """A cooked patty: dark brown with grill marks."""
    canvas = _food_canvas(style)
    tones = style.cooked
    canvas.shadow((0, -11), (39, 13))
    canvas.disc(_RADII, LEVEL_HEIGHT - 2, tones)
    _rim(canvas, tones)
    for shift in (-19, -6.5, 6, 18.5):
        reach = 10.0 * math.sqrt(max(0.0, 1 - (shift / 33) ** 2))
        canvas.line([(shift - 4, -34 + reach), (shift + 4, -34 - reach)], tones.dark, 3.4)
    for x, y in ((-25, -16), (-9, -9), (7, -15), (22, -11)):
        canvas.ellipse((x, y), (3.2, 1.6), tones.dark)
    return canvas.finish()


def draw_topbun(style: Style) -> Sprite:
    """The upper half of a bun: a shining dome with sesame seeds."""
    canvas = _food_canvas(style)
    tones, line = style.topbun, style.outline_width
    canvas.shadow((0, -11), (39, 13))
    for extra, colour in ((line, style.outline), (0.0, tones.dark)):
        canvas.polygon(_dome(37.0 + extra, 44.0 + extra, 12.0 + extra), colour)
    canvas.polygon(_dome(37.0, 44.0, 6.0), tones.base)
    canvas.polygon([(x * 0.62 - 3, y * 0.45 - 22) for x, y in _dome(37.0, 44.0, 12.0)], tones.light)
    canvas.ellipse((0, -25), (26, 11), tones.base)
    for x, y in _seed_places():
        canvas.ellipse((x, y), (2.5, 1.6), style.seeds)
    return canvas.finish()


def draw_bottombun(style: Style) -> Sprite:
    """The lower half of a bun: flat, with a pale cut side."""
    canvas = _food_canvas(style)
    tones, line = style.bottombun, style.outline_width
    canvas.shadow((0, -10), (37, 12))
    for extra, colour in ((line, style.outline), (0.0, tones.dark)):
        canvas.polygon(_bowl(37.0 + extra, 32.0 + extra), colour)
        canvas.ellipse((0, -32), (37.0 + extra, 12.0 + extra), colour)
    canvas.polygon(_bowl(37.0, 28.0), tones.base)
    canvas.ellipse((0, -32), (37, 12), tones.base)
    canvas.arc((0, -32), (37, 12), (4, 176), tones.dark, 1.6)
    canvas.ellipse((0, -32.5), (33, 9.6), tones.light)
    for x, y in ((-14, -34), (-2, -36), (9, -32), (17, -35), (-6, -31)):
        canvas.ellipse((x, y), (2.0, 0.9), tones.base)
    return canvas.finish()


def _food_canvas(style: Style) -> Canvas:
    return Canvas(style, left=44, up=54, right=44, down=6)


def _rim(canvas: Canvas, tones: Tones) -> None:
    """The lower edge of a disc lies in the shade."""
    rx, ry = _RADII
    canvas.arc((0, -ry - 1), (rx, ry), (12, 168), tones.dark, 4.0)


def _wavy(rx: float, ry: float, middle: float, depth: float) -> list[Point]:
    """An ellipse around (0, middle) whose edge goes in and out."""
    points = []
    for step in range(180):
        angle = math.tau * step / 180
        wave = 1 + depth / rx * math.sin(_LEAVES * angle)
        points.append((rx * wave * math.cos(angle), middle + ry * wave * math.sin(angle)))
    return points


def _dome(rx: float, height: float, ry: float) -> list[Point]:
    """Upper half of a squarish ellipse on the lower half of a flat one."""
    base = -12.0
    upper = []
    for step in range(61):
        angle = math.pi * step / 60
        cosine, sine = math.cos(angle), math.sin(angle)
        reach = math.copysign(abs(cosine) ** 0.8, cosine)
        upper.append((rx * reach, base - (height + base) * sine**0.8))
    lower = [
        (-rx * math.cos(math.pi * s / 60), base + ry * math.sin(math.pi * s / 60))
        for s in range(61)
    ]
    return upper + lower


def _bowl(rx: float, depth: float) -> list[Point]:
    """The lower half of a squarish ellipse below the rim of a disc."""
    points = []
    for step in range(61):
        angle = math.pi * step / 60
        cosine, sine = math.cos(angle), math.sin(angle)
        points.append((math.copysign(rx * abs(cosine) ** 0.55, cosine), depth * sine**0.8 - 32.0))
    return points


def _seed_places() -> tuple[Point, ...]:
    return (
        (-24, -16), (-12, -11), (1, -14), (13, -10), (25, -17),
        (-18, -25), (-5, -23), (8, -24), (19, -28), (-9, -34), (3, -37), (13, -35),
    )  # fmt: skip

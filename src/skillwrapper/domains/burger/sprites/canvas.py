"""A small drawing surface with smooth edges: drawn large, then scaled down."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from PIL import Image, ImageDraw

from skillwrapper.domains.burger.style import Colour, Style, Tones

_SCALE: Final = 4

Point = tuple[float, float]


@dataclass(frozen=True)
class Sprite:
    """A picture with transparency.

    Attributes:
        image: RGBA.
        anchor: the pixel of it that stands on the floor, or on what is beneath.
    """

    image: Image.Image
    anchor: tuple[int, int]


class Canvas:
    """Draws in pixels of the finished sprite, with the origin at the sprite's anchor.

    Columns grow to the right and rows downwards, so what stands above the anchor has negative rows.

    Args:
        style: colours and lines.
        left: how far the canvas reaches to the left of the anchor, in pixels.
        up: how far it reaches upwards.
        right: how far it reaches to the right.
        down: how far it reaches downwards.
    """

    def __init__(self, style: Style, left: int, up: int, right: int, down: int) -> None:
        self.style = style
        self._origin = (left, up)
        size = ((left + right) * _SCALE, (up + down) * _SCALE)
        self._image = Image.new("RGBA", size, (0, 0, 0, 0))
        self._draw = ImageDraw.Draw(self._image)

    def finish(self) -> Sprite:
        """The sprite in its final size."""
        return Sprite(self._image.reduce(_SCALE), self._origin)

    def ellipse(self, centre: Point, radii: Point, colour: Colour, opacity: int = 255) -> None:
        """A filled ellipse."""
        (x, y), (rx, ry) = centre, radii
        self._draw.ellipse(self._scaled((x - rx, y - ry), (x + rx, y + ry)), (*colour, opacity))

    def box(self, corner: Point, opposite: Point, colour: Colour, radius: float = 0) -> None:
        """A filled rectangle between its upper left and lower right corner."""
        box = self._scaled(corner, opposite)
        self._draw.rounded_rectangle(box, radius * _SCALE, (*colour, 255))

    def polygon(self, points: list[Point], colour: Colour) -> None:
        """A filled polygon."""
        self._draw.polygon(self._scaled(*points), (*colour, 255))

    def line(self, points: list[Point], colour: Colour, width: float) -> None:
        """A line with round joints and ends."""
        scaled = self._scaled(*points)
        self._draw.line(scaled, (*colour, 255), round(width * _SCALE), joint="curve")
        for end in (points[0], points[-1]):
            self.ellipse(end, (width / 2, width / 2), colour)

    def arc(
        self, centre: Point, radii: Point, degrees: Point, colour: Colour, width: float
    ) -> None:
        """A part of an ellipse's line, between two angles in degrees, clockwise from the right."""
        (x, y), (rx, ry) = centre, radii
        box = self._scaled((x - rx, y - ry), (x + rx, y + ry))
        self._draw.arc(box, *degrees, (*colour, 255), round(width * _SCALE))

    def outlined_ellipse(self, centre: Point, radii: Point, colour: Colour) -> None:
        """An ellipse with the style's outline around it."""
        line = self.style.outline_width
        self.ellipse(centre, (radii[0] + line, radii[1] + line), self.style.outline)
        self.ellipse(centre, radii, colour)

    def outlined_box(
        self, corner: Point, opposite: Point, colour: Colour, radius: float = 0
    ) -> None:
        """A rectangle with the style's outline around it."""
        line = self.style.outline_width
        outer = (corner[0] - line, corner[1] - line), (opposite[0] + line, opposite[1] + line)
        self.box(*outer, self.style.outline, radius + line)
        self.box(corner, opposite, colour, radius)

    def disc(self, radii: Point, height: float, tones: Tones) -> None:
        """A flat cylinder that stands on the anchor: its side in base, its top in light tone."""
        rx, ry = radii
        line = self.style.outline_width
        self._cylinder(-ry, (rx + line, ry + line), height, self.style.outline)
        self._cylinder(-ry, radii, height, tones.base)
        self.ellipse((0, -ry - height), radii, tones.light)

    def shadow(self, centre: Point, radii: Point) -> None:
        """A soft shadow on what is beneath."""
        # Drawing replaces what is there, opacity included; the inner ellipse thus gets its own.
        for part, strength in ((1.0, 0.4), (0.92, 0.7), (0.84, 1.0)):
            opacity = round(self.style.shadow_opacity * strength)
            self.ellipse(centre, (radii[0] * part, radii[1] * part), (0, 0, 0), opacity)

    def _cylinder(self, centre: float, radii: Point, height: float, colour: Colour) -> None:
        self.ellipse((0, centre), radii, colour)
        self.ellipse((0, centre - height), radii, colour)
        self.box((-radii[0], centre - height), (radii[0], centre), colour)

    def _scaled(self, *points: Point) -> list[float]:
        left, up = self._origin
        return [c for x, y in points for c in ((x + left) * _SCALE, (y + up) * _SCALE)]

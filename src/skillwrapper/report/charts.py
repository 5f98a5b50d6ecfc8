"""Line charts as numbers that a template turns into SVG."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

_WIDTH, _HEIGHT = 320, 176
_LEFT, _RIGHT, _TOP, _BOTTOM = 40, 14, 12, 30
_MOST_STEPS = 5
_SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True)
class Tick:
    """A mark on an axis.

    Attributes:
        at: in pixels.
        text: what stands there.
    """

    at: float
    text: str


@dataclass(frozen=True)
class Dot:
    """A point of a curve.

    Attributes:
        x: in pixels.
        y: in pixels.
        text: its numbers, for people.
    """

    x: float
    y: float
    text: str


@dataclass(frozen=True)
class Series:
    """A curve.

    Attributes:
        label: what it shows.
        points: pairs of x and y, by x.
    """

    label: str
    points: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class LineChart:
    """A small chart of one or more curves over the number of executions.

    Attributes:
        title: what is seen.
        series: the curves.
        share: whether the values are shares of 1, shown in percent.
    """

    title: str
    series: tuple[Series, ...]
    share: bool = False

    width = _WIDTH
    height = _HEIGHT
    left = _LEFT
    right = _WIDTH - _RIGHT
    bottom = _HEIGHT - _BOTTOM

    @cached_property
    def x_ticks(self) -> tuple[Tick, ...]:
        """Marks of executions."""
        return tuple(Tick(self._x(v), f"{v:g}") for v in round_steps(self._most_x))

    @cached_property
    def y_ticks(self) -> tuple[Tick, ...]:
        """Marks of values."""
        values = _SHARES if self.share else round_steps(self._most_y)
        return tuple(Tick(self._y(v), self._text(v)) for v in values)

    def dots(self, series: Series) -> tuple[Dot, ...]:
        """The points of a curve in pixels."""
        return tuple(
            Dot(self._x(x), self._y(y), f"{x:g} executions: {self._text(y)}")
            for x, y in series.points
        )

    def line(self, series: Series) -> str:
        """A curve as the ``points`` of an SVG polyline."""
        return " ".join(f"{dot.x:g},{dot.y:g}" for dot in self.dots(series))

    def area(self, series: Series) -> str:
        """The area under a curve as the ``points`` of an SVG polygon."""
        dots = self.dots(series)
        if not dots:
            return ""
        ends = f"{dots[-1].x:g},{self.bottom} {dots[0].x:g},{self.bottom}"
        return f"{self.line(series)} {ends}"

    @property
    def summary(self) -> str:
        """The last value of every curve, for those who cannot see it."""
        ends = (f"{s.label} {self._text(s.points[-1][1])}" for s in self.series if s.points)
        return f"{self.title}: at the end {', '.join(ends)}"

    @cached_property
    def _most_x(self) -> float:
        return max((x for s in self.series for x, _ in s.points), default=1.0) or 1.0

    @cached_property
    def _most_y(self) -> float:
        if self.share:
            return 1.0
        return round_steps(max((y for s in self.series for _, y in s.points), default=0))[-1]

    def _x(self, value: float) -> float:
        return round(_LEFT + (self.right - _LEFT) * value / self._most_x, 1)

    def _y(self, value: float) -> float:
        return round(self.bottom - (self.bottom - _TOP) * value / self._most_y, 1)

    def _text(self, value: float) -> str:
        return f"{value:.0%}" if self.share else f"{value:g}"


def round_steps(most: float) -> tuple[int, ...]:
    """Whole, round numbers from 0 to the first one that is not below ``most``, six at most."""
    step = next(step for step in _steps() if most / step <= _MOST_STEPS)
    return tuple(step * number for number in range(max(1, math.ceil(most / step)) + 1))


def _steps() -> Iterator[int]:
    """1, 2, 5, 10, 20, 50, ..."""
    for power in itertools.count():
        yield from (factor * 10**power for factor in (1, 2, 5))

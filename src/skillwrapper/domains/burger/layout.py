"""Where furniture and robot stand in the picture."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Final

from skillwrapper.domains.burger.states import ITEMS, STATIONS

PICTURE_SIZE: Final = 512
"""Width and height of a picture in pixels."""
_CELL_WIDTH: Final = 160
_CELL_HEIGHT: Final = 163
"""A place with a stack of four takes 160 pixels, so that it touches nothing above it."""
_LEFT: Final = 16
_LOWEST_ROW: Final = 505
_SIDEWAYS, _UPWARDS = 18, 3
"""How far from the regular place in its cell a thing may stand, in pixels."""


@dataclass(frozen=True, order=True)
class Spot:
    """Where a thing stands on the floor, in pixels from the upper left corner.

    Attributes:
        x: column of its middle.
        y: row of its lower front edge.
    """

    x: int
    y: int


@dataclass(frozen=True)
class Layout:
    """One arrangement of the kitchen.

    Attributes:
        robot: where the robot stands.
        stations: one spot for each of ``STATIONS``.
        tables: the table of each of ``ITEMS``, where it starts.
    """

    robot: Spot
    stations: tuple[Spot, ...]
    tables: tuple[Spot, ...]

    def station(self, name: str) -> Spot:
        """The spot of a station."""
        return self.stations[STATIONS.index(name)]

    def table_of(self, item: str) -> Spot:
        """The spot of the table where an item starts."""
        return self.tables[ITEMS.index(item)]

    @property
    def spots(self) -> tuple[Spot, ...]:
        """All spots, robot first."""
        return (self.robot, *self.stations, *self.tables)


def make_layout(seed: int) -> Layout:
    """The arrangement of a seed: things stand in different cells of a grid of three by three."""
    chance = random.Random(f"burger layout {seed}")
    cells = [(column, row) for row in range(3) for column in range(3)]
    chance.shuffle(cells)
    robot, *others = (_spot_in(cell, chance) for cell in cells[: 1 + len(STATIONS) + len(ITEMS)])
    return Layout(robot, tuple(others[: len(STATIONS)]), tuple(others[len(STATIONS) :]))


def _spot_in(cell: tuple[int, int], chance: random.Random) -> Spot:
    column, row = cell
    return Spot(
        _LEFT + _CELL_WIDTH * column + _CELL_WIDTH // 2 + chance.randint(-_SIDEWAYS, _SIDEWAYS),
        _LOWEST_ROW - _CELL_HEIGHT * (2 - row) - chance.randint(0, _UPWARDS),
    )

"""Where things start on a table, with room around each."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from skillwrapper.domains.tabletop.poses import Pose

_GAP: Final = 0.015
"""Between the circles of two things, in metres."""
_TRIES: Final = 20


@dataclass(frozen=True)
class Place:
    """A place on the table.

    Attributes:
        x: metres from the robot.
        y: metres to its left.
        yaw: how far a thing there is turned, in radians.
    """

    x: float
    y: float
    yaw: float

    def pose(self, height: float) -> Pose:
        """The pose of a frame at a height."""
        return Pose.at(self.x, self.y, height, self.yaw)


Layout = Mapping[str, Place]
"""The place of each thing."""


def scatter(
    radii: Mapping[str, float],
    draw: Callable[[str, random.Random], Place],
    chance: random.Random,
) -> Layout:
    """Places of things whose circles do not meet.

    Args:
        radii: of the circle around each thing that is kept free, in metres.
        draw: a place for a thing by chance.
        chance: all that places depend on.
    """
    while True:
        places = _try(radii, draw, chance)
        if places is not None:
            return {thing: places[thing] for thing in radii}


def _try(
    radii: Mapping[str, float],
    draw: Callable[[str, random.Random], Place],
    chance: random.Random,
) -> Layout | None:
    """One thing after the other, those that need most room first; None if one finds no place."""
    places: dict[str, Place] = {}
    for thing in sorted(radii, key=lambda name: -radii[name]):
        others = [(place, radii[thing] + radii[name]) for name, place in places.items()]
        drawn = (draw(thing, chance) for _ in range(_TRIES))
        place = next((p for p in drawn if _is_free(p, others)), None)
        if place is None:
            return None
        places[thing] = place
    return places


def _is_free(place: Place, others: Sequence[tuple[Place, float]]) -> bool:
    return all(
        math.hypot(place.x - other.x, place.y - other.y) >= apart + _GAP for other, apart in others
    )

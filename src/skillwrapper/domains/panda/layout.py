"""Where things start on the table."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from skillwrapper.domains.panda.objects import HANDLING
from skillwrapper.domains.panda.states import SPONGE, TEAPOT
from skillwrapper.domains.tabletop.poses import Pose

_NEAR, _FAR = 0.41, 0.64
"""How far from the robot things stand, in metres; the arm reaches all of it with some to spare."""
_SIDE: Final = 0.36
_TURN: Final = 1.2
"""How far the fingers may turn from where they are at home to close on a long thing, in radians."""
_GAP: Final = 0.015
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


def make_layout(things: Sequence[str], seed: int) -> Layout:
    """Places of things, with room around each for the gripper; a function of its arguments."""
    chance = random.Random(f"panda layout {seed}")
    while True:
        places = _try(things, chance)
        if places is not None:
            return places


def _try(things: Sequence[str], chance: random.Random) -> Layout | None:
    """One thing after the other, those that need most room first; None if one finds no place."""
    places: dict[str, Place] = {}
    for thing in sorted(things, key=lambda name: -HANDLING[name].radius):
        drawn = (_draw(thing, chance) for _ in range(_TRIES))
        place = next((p for p in drawn if _is_free(thing, p, places)), None)
        if place is None:
            return None
        places[thing] = place
    return {thing: places[thing] for thing in things}


def _draw(thing: str, chance: random.Random) -> Place:
    x, y = chance.uniform(_NEAR, _FAR), chance.uniform(-_SIDE, _SIDE)
    if thing not in (TEAPOT, SPONGE):
        return Place(x, y, chance.uniform(-math.pi, math.pi))
    fingers = chance.uniform(-_TURN, _TURN)
    return Place(x, y, fingers + math.pi * (chance.choice((0.5, -0.5)) if thing == TEAPOT else 0.5))


def _is_free(thing: str, place: Place, places: Layout) -> bool:
    return all(
        math.hypot(place.x - other.x, place.y - other.y)
        >= HANDLING[thing].radius + HANDLING[name].radius + _GAP
        for name, other in places.items()
    )

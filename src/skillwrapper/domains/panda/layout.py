"""Where things start on the table."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import Final

from skillwrapper.domains.panda.objects import HANDLING
from skillwrapper.domains.panda.states import SPONGE, TEAPOT
from skillwrapper.domains.tabletop.layout import Layout, Place, scatter

_NEAR, _FAR = 0.41, 0.64
"""How far from the robot things stand, in metres; the arm reaches all of it with some to spare."""
_SIDE: Final = 0.36
_TURN: Final = 1.2
"""How far the fingers may turn from where they are at home to close on a long thing, in radians."""


def make_layout(things: Sequence[str], seed: int) -> Layout:
    """Places of things, with room around each for the gripper; a function of its arguments."""
    radii = {thing: HANDLING[thing].radius for thing in things}
    return scatter(radii, _draw, random.Random(f"panda layout {seed}"))


def _draw(thing: str, chance: random.Random) -> Place:
    x, y = chance.uniform(_NEAR, _FAR), chance.uniform(-_SIDE, _SIDE)
    if thing not in (TEAPOT, SPONGE):
        return Place(x, y, chance.uniform(-math.pi, math.pi))
    fingers = chance.uniform(-_TURN, _TURN)
    return Place(x, y, fingers + math.pi * (chance.choice((0.5, -0.5)) if thing == TEAPOT else 0.5))

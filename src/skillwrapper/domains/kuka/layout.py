"""Where things start on the two arms' table."""

from __future__ import annotations

import random
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from skillwrapper.domains.kuka.objects import HOLDER
from skillwrapper.domains.kuka.states import BREAD, JAR
from skillwrapper.domains.tabletop.layout import Layout, Place, scatter

_RADII: Final[Mapping[str, float]] = MappingProxyType({BREAD: 0.080, JAR: 0.055, HOLDER: 0.055})
_Range = tuple[float, float]
_RANGES: Final[Mapping[str, tuple[_Range, _Range, _Range]]] = MappingProxyType(
    {
        JAR: ((0.46, 0.56), (0.11, 0.23), (-3.1, 3.1)),
        HOLDER: ((0.49, 0.57), (-0.25, -0.15), (-0.5, 0.5)),
        BREAD: ((0.35, 0.41), (0.02, 0.08), (-0.5, 0.5)),
    }
)
"""Lowest and highest x, y and turn; the arms reach all of it with some to spare."""


def make_layout(seed: int) -> Layout:
    """Places of jar, bread and the knife's holder; a function of the seed."""
    return scatter(_RADII, _draw, random.Random(f"kuka layout {seed}"))


def _draw(thing: str, chance: random.Random) -> Place:
    return Place(*(chance.uniform(*span) for span in _RANGES[thing]))

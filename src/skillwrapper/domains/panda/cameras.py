"""Where the table is seen from."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from skillwrapper.domains.tabletop.cameras import Camera

FRONT, SIDE, FAR = "front", "side", "far"

CAMERAS: Final[Mapping[str, Camera]] = MappingProxyType(
    {
        FRONT: Camera((1.32, 0.0, 0.80), (0.41, 0.0, 0.12), 42.0),
        SIDE: Camera((0.95, -0.95, 0.75), (0.45, 0.0, 0.10), 42.0),
        FAR: Camera((1.80, 0.45, 1.10), (0.42, 0.0, 0.10), 34.0),
    }
)
"""The first is the usual one; the others are for studies of viewpoints."""

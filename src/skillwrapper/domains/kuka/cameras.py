"""Where the two arms' table is seen from."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from skillwrapper.domains.tabletop.cameras import Camera

EGO, HIGH, OPPOSITE = "ego", "high", "opposite"

CAMERAS: Final[Mapping[str, Camera]] = MappingProxyType(
    {
        EGO: Camera((0.02, 0.0, 1.16), (0.48, 0.0, 0.08), 50.0),
        HIGH: Camera((0.10, 0.12, 1.30), (0.47, 0.0, 0.08), 46.0),
        OPPOSITE: Camera((1.45, 0.25, 0.95), (0.42, 0.0, 0.14), 44.0),
    }
)
"""The first is between the robot's shoulders; the others are for studies of viewpoints."""

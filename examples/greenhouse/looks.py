"""How things look: what whoever draws the greenhouse and whoever looks at it both know."""

from __future__ import annotations

from types import MappingProxyType

Colour = tuple[int, int, int]

SIZE = (400, 260)
"""Width and height of a picture, in pixels."""

ROBOT: Colour = (96, 108, 128)
POTS = MappingProxyType(
    {
        "red_pot": (196, 70, 56),
        "blue_pot": (60, 104, 188),
        "yellow_pot": (234, 186, 52),
        "white_pot": (250, 250, 252),
    }
)
KNOBS = MappingProxyType({"brass_bell": (214, 150, 20), "iron_bell": (24, 24, 28)})
DRY_SOIL: Colour = (190, 156, 116)
WET_SOIL: Colour = (84, 58, 38)
LEAF: Colour = (58, 128, 62)
SHOOT: Colour = (150, 206, 84)

# Only the drawing uses these.
WALL: Colour = (224, 236, 240)
PANE: Colour = (206, 222, 230)
BENCH: Colour = (160, 124, 92)
BENCH_FRONT: Colour = (132, 98, 70)
GLASS: Colour = (140, 184, 200)
FACE: Colour = (40, 46, 60)
EYE: Colour = (130, 240, 230)

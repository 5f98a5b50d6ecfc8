"""The colours and lines of the pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

Colour = tuple[int, int, int]


@dataclass(frozen=True)
class Tones:
    """Three shades of one material.

    Attributes:
        light: what catches the light.
        base: the material's colour.
        dark: what lies in the shade.
    """

    light: Colour
    base: Colour
    dark: Colour


@dataclass(frozen=True)
class Style:
    """One way to draw the kitchen; the shapes are the same in all of them.

    Attributes:
        name: for file names and tables.
        outline: colour of the lines around things.
        outline_width: in pixels.
        shadow_opacity: 0 (none) to 255.
        floor: two tiles and the joints between them.
        wall: wall at the upper edge.
        table: tables.
        stove: cabinet of the stove.
        fire: burner and oven window.
        board: cabinet of the cutting board.
        wood: the board itself.
        steel: knife, knobs and handles.
        robot: body of the robot.
        face: screen (base) and eyes (light) of the robot.
        lettuce: head of lettuce.
        shreds: lettuce that is cut.
        raw: patty that is raw.
        cooked: patty that is cooked; the dark tone is that of the grill marks.
        topbun: upper half of the bun; the light tone is that of the shine.
        seeds: sesame seeds.
        bottombun: lower half of the bun; the light tone is that of its cut side.
    """

    name: str
    outline: Colour
    outline_width: float
    shadow_opacity: int
    floor: Tones
    wall: Tones
    table: Tones
    stove: Tones
    fire: Tones
    board: Tones
    wood: Tones
    steel: Tones
    robot: Tones
    face: Tones
    lettuce: Tones
    shreds: Tones
    raw: Tones
    cooked: Tones
    topbun: Tones
    seeds: Colour
    bottombun: Tones


CLASSIC: Final = Style(
    name="classic",
    outline=(58, 48, 66),
    outline_width=1.6,
    shadow_opacity=46,
    floor=Tones((243, 239, 232), (233, 227, 217), (222, 215, 203)),
    wall=Tones((214, 222, 226), (190, 201, 208), (150, 163, 174)),
    table=Tones((186, 216, 240), (158, 196, 228), (112, 154, 196)),
    stove=Tones((116, 120, 130), (84, 88, 98), (58, 61, 70)),
    fire=Tones((255, 214, 110), (255, 104, 58), (190, 52, 36)),
    board=Tones((92, 178, 178), (42, 132, 138), (26, 100, 108)),
    wood=Tones((218, 184, 152), (198, 156, 122), (150, 108, 82)),
    steel=Tones((240, 243, 246), (212, 218, 224), (150, 158, 168)),
    robot=Tones((172, 152, 236), (132, 108, 212), (94, 74, 170)),
    face=Tones((126, 240, 250), (44, 38, 72), (30, 26, 52)),
    lettuce=Tones((126, 194, 70), (88, 164, 50), (54, 122, 38)),
    shreds=Tones((236, 248, 192), (210, 236, 146), (174, 214, 110)),
    raw=Tones((252, 186, 190), (240, 134, 144), (212, 98, 114)),
    cooked=Tones((132, 80, 50), (104, 58, 36), (52, 28, 20)),
    topbun=Tones((240, 176, 100), (216, 126, 44), (174, 92, 30)),
    seeds=(255, 246, 220),
    bottombun=Tones((255, 242, 190), (247, 200, 92), (226, 168, 60)),
)
"""The usual drawing: bright, warm food in a calm kitchen."""

CHALK: Final = Style(
    name="chalk",
    outline=(244, 242, 232),
    outline_width=2.4,
    shadow_opacity=0,
    floor=Tones((52, 66, 62), (46, 59, 56), (60, 76, 71)),
    wall=Tones((70, 88, 82), (58, 74, 69), (84, 102, 96)),
    table=Tones((96, 122, 160), (78, 102, 140), (58, 80, 116)),
    stove=Tones((92, 92, 96), (70, 70, 76), (44, 44, 50)),
    fire=Tones((255, 226, 140), (238, 120, 92), (160, 64, 56)),
    board=Tones((84, 140, 140), (58, 112, 114), (42, 88, 92)),
    wood=Tones((214, 184, 150), (190, 156, 120), (150, 116, 86)),
    steel=Tones((236, 238, 240), (204, 210, 214), (150, 156, 162)),
    robot=Tones((190, 168, 226), (156, 132, 200), (118, 96, 162)),
    face=Tones((170, 236, 240), (50, 46, 66), (36, 32, 50)),
    lettuce=Tones((150, 200, 112), (116, 170, 84), (84, 134, 62)),
    shreds=Tones((226, 240, 190), (202, 224, 152), (164, 198, 112)),
    raw=Tones((248, 196, 200), (228, 150, 160), (200, 118, 132)),
    cooked=Tones((134, 92, 68), (110, 72, 52), (60, 38, 30)),
    topbun=Tones((232, 182, 124), (208, 140, 78), (170, 108, 56)),
    seeds=(255, 250, 232),
    bottombun=Tones((252, 240, 200), (238, 208, 124), (212, 176, 90)),
)
"""Pastel drawings on a blackboard, for studies of how much a drawing matters."""

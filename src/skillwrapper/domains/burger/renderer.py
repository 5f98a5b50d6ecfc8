"""Pictures of the burger kitchen, a function of state, layout and style alone."""

from __future__ import annotations

from functools import lru_cache

from PIL import Image

from skillwrapper.domains.burger.backdrop import draw_backdrop
from skillwrapper.domains.burger.layout import Layout, Spot
from skillwrapper.domains.burger.sprites.canvas import Sprite
from skillwrapper.domains.burger.sprites.food import (
    LEVEL_HEIGHT,
    draw_bottombun,
    draw_cooked_patty,
    draw_lettuce,
    draw_raw_patty,
    draw_shreds,
    draw_topbun,
)
from skillwrapper.domains.burger.sprites.furniture import (
    SURFACE_HEIGHT,
    draw_board,
    draw_stove,
    draw_table,
)
from skillwrapper.domains.burger.sprites.robot import HAND_HEIGHT, draw_robot
from skillwrapper.domains.burger.states import ITEMS, STATIONS, TABLE, BurgerState
from skillwrapper.domains.burger.style import CLASSIC, Style

_KEPT_BACKGROUNDS = 8


class BurgerRenderer:
    """Draws states; everything that can be drawn once is drawn once.

    Args:
        style: colours and lines.
    """

    def __init__(self, style: Style = CLASSIC) -> None:
        self.style = style
        self._stations = {"stove": draw_stove(style), "board": draw_board(style)}
        self._table = draw_table(style)
        self._robots = {
            carrying: draw_robot(style, carrying=carrying) for carrying in (False, True)
        }
        self._lettuce = {False: draw_lettuce(style), True: draw_shreds(style)}
        self._patty = {False: draw_raw_patty(style), True: draw_cooked_patty(style)}
        self._buns = {"topbun": draw_topbun(style), "bottombun": draw_bottombun(style)}
        self._background = lru_cache(maxsize=_KEPT_BACKGROUNDS)(self._draw_background)

    def render(self, state: BurgerState, layout: Layout) -> Image.Image:
        """The picture (512, 512) in RGB."""
        image = self._background(layout).copy()
        held = state.held
        _paste(image, self._robots[held is not None], layout.robot)
        if held is not None:
            hand = Spot(layout.robot.x, layout.robot.y - HAND_HEIGHT)
            _paste(image, self._sprite(held, state), hand)
        for item, place in zip(ITEMS, state.places, strict=True):
            if place == TABLE:
                self._paste_stack(image, state, item, layout.table_of(item))
            elif place in STATIONS:
                self._paste_stack(image, state, item, layout.station(place))
        return image

    def _draw_background(self, layout: Layout) -> Image.Image:
        image = draw_backdrop(self.style)
        for name in STATIONS:
            _paste(image, self._stations[name], layout.station(name))
        for spot in layout.tables:
            _paste(image, self._table, spot)
        return image

    def _paste_stack(self, image: Image.Image, state: BurgerState, item: str, spot: Spot) -> None:
        for level, name in enumerate(state.stack_from(item)):
            height = SURFACE_HEIGHT + level * LEVEL_HEIGHT
            _paste(image, self._sprite(name, state), Spot(spot.x, spot.y - height))

    def _sprite(self, item: str, state: BurgerState) -> Sprite:
        if item == "lettuce":
            return self._lettuce[state.cut]
        if item == "patty":
            return self._patty[state.cooked]
        return self._buns[item]


def _paste(image: Image.Image, sprite: Sprite, spot: Spot) -> None:
    corner = (spot.x - sprite.anchor[0], spot.y - sprite.anchor[1])
    image.paste(sprite.image, corner, sprite.image)

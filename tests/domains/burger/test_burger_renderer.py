from __future__ import annotations

import hashlib
import itertools

import numpy as np
import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.layout import PICTURE_SIZE, Layout, Spot, make_layout
from skillwrapper.domains.burger.renderer import BurgerRenderer
from skillwrapper.domains.burger.states import ITEMS, BurgerState
from skillwrapper.domains.burger.style import CHALK, CLASSIC, Style

WALL = 18
REACH_SIDEWAYS, REACH_UP, REACH_DOWN = 60, 157, 3
"""How far a place with everything on it may reach from its spot, in pixels."""


def area(spot: Spot) -> tuple[slice, slice]:
    """Rows and columns of a place."""
    return (
        slice(spot.y - REACH_UP, spot.y + REACH_DOWN),
        slice(spot.x - REACH_SIDEWAYS, spot.x + REACH_SIDEWAYS),
    )


def overlap(one: Spot, other: Spot) -> bool:
    return abs(one.x - other.x) < 2 * REACH_SIDEWAYS and abs(one.y - other.y) < (
        REACH_UP + REACH_DOWN
    )


def pile_on(place: str, lowest: str) -> BurgerState:
    """All four items in one stack."""
    order = (lowest, *(item for item in ITEMS if item != lowest))
    below = dict(zip(order, (place, *order), strict=False))
    return BurgerState(tuple(below[item] for item in ITEMS))


def spot_of(layout: Layout, place: str, lowest: str) -> Spot:
    return layout.table_of(lowest) if place == "table" else layout.station(place)


def test_layouts_differ_and_repeat() -> None:
    layouts = [make_layout(seed) for seed in range(50)]
    assert layouts == [make_layout(seed) for seed in range(50)]
    assert len(set(layouts)) == 50
    assert len({layout.robot for layout in layouts}) > 20


@pytest.mark.parametrize("seed", range(40))
def test_places_keep_apart_and_within_the_picture(seed: int) -> None:
    spots = make_layout(seed).spots
    assert len(spots) == 7
    assert not any(overlap(one, other) for one, other in itertools.combinations(spots, 2))
    for spot in spots:
        assert spot.y - REACH_UP >= WALL
        assert spot.y + REACH_DOWN <= PICTURE_SIZE
        assert REACH_SIDEWAYS <= spot.x <= PICTURE_SIZE - REACH_SIDEWAYS


@pytest.mark.parametrize("seed", range(4))
def test_a_stack_of_four_stays_at_its_place(seed: int) -> None:
    renderer, layout = BurgerRenderer(), make_layout(seed)
    start = np.asarray(renderer.render(BurgerState(), layout))
    for place, lowest in itertools.product(("stove", "board", "table"), ITEMS):
        pile = np.asarray(renderer.render(pile_on(place, lowest), layout))
        changed = (pile != start).any(axis=2)
        # The lowest item of a pile on its table is at the same place as at the start.
        assert changed[area(spot_of(layout, place, lowest))].sum() > 2000
        for spot in (*layout.tables, spot_of(layout, place, lowest)):
            changed[area(spot)] = False
        assert not changed.any()


@pytest.mark.parametrize(("style", "step"), [(CLASSIC, 1), (CHALK, 8)])
def test_different_states_look_different(style: Style, step: int) -> None:
    renderer, layout = BurgerRenderer(style), make_layout(5)
    states = BurgerEnvironment().reachable_states()[::step]
    pictures = (renderer.render(state, layout).tobytes() for state in states)
    assert len({hashlib.sha1(picture).digest() for picture in pictures}) == len(states)


def test_picture_is_a_function_of_state_and_layout() -> None:
    one, other = BurgerRenderer(), BurgerRenderer()
    state, layout = pile_on("stove", "patty"), make_layout(7)
    expected = one.render(state, layout)
    assert (expected.size, expected.mode) == ((PICTURE_SIZE, PICTURE_SIZE), "RGB")
    for seed in range(12):  # more layouts than the renderer keeps backgrounds of
        one.render(BurgerState(), make_layout(seed))
    assert one.render(state, layout).tobytes() == expected.tobytes()
    assert other.render(state, make_layout(7)).tobytes() == expected.tobytes()


def test_drawing_leaves_the_kept_background_alone() -> None:
    renderer, layout = BurgerRenderer(), make_layout(7)
    before = renderer.render(BurgerState(), layout).tobytes()
    renderer.render(pile_on("board", "topbun"), layout)
    assert renderer.render(BurgerState(), layout).tobytes() == before

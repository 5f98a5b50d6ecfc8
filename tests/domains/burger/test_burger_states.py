from __future__ import annotations

import re
from typing import Any

import pytest

from skillwrapper.domains.burger.states import (
    HAND,
    TABLE,
    BurgerState,
    state_from_data,
    state_to_data,
)
from skillwrapper.errors import ConfigurationError

# Places are those of lettuce, patty, topbun and bottombun.
BURGER = BurgerState(("patty", "bottombun", "lettuce", "board"), cut=True, cooked=True)


def test_start_has_everything_on_tables() -> None:
    start = BurgerState()
    assert start.held is None
    assert {start.place_of(item) for item in ("lettuce", "patty", "topbun", "bottombun")} == {TABLE}


def test_stack_is_told_from_the_lowest_to_the_highest() -> None:
    assert BURGER.item_on("board") == "bottombun"
    assert BURGER.stack_from("bottombun") == ("bottombun", "patty", "lettuce", "topbun")
    assert BURGER.stack_from("topbun") == ("topbun",)


def test_moving_leaves_everything_else() -> None:
    moved = BURGER.moved("topbun", HAND)
    assert moved.held == "topbun"
    assert moved == BurgerState(("patty", "bottombun", HAND, "board"), cut=True, cooked=True)
    assert BURGER.held is None


@pytest.mark.parametrize(
    ("places", "message"),
    [
        ((TABLE,) * 3, "expected 4 places, got 3"),
        ((TABLE, TABLE, TABLE, "sink"), "got 'sink'"),
        ((HAND, HAND, TABLE, TABLE), "at most one item at 'hand'"),
        (("stove", "stove", TABLE, TABLE), "at most one item at 'stove'"),
        (("patty", TABLE, "patty", TABLE), "at most one item at 'patty'"),
        (("patty", HAND, TABLE, TABLE), "nothing on the held patty, got the lettuce"),
        (("patty", "lettuce", TABLE, TABLE), "got a circle"),
        (("lettuce", TABLE, TABLE, TABLE), "got a circle"),
        (("topbun", "lettuce", "patty", TABLE), "got a circle"),
    ],
)
def test_impossible_state_is_refused(places: tuple[str, ...], message: str) -> None:
    with pytest.raises(ConfigurationError, match=re.escape(message)):
        BurgerState(places)


def test_data_is_plain_and_comes_back() -> None:
    data = state_to_data(BURGER)
    assert data == {
        "places": {
            "lettuce": "patty",
            "patty": "bottombun",
            "topbun": "lettuce",
            "bottombun": "board",
        },
        "cut": True,
        "cooked": True,
    }
    assert state_from_data(data) == BURGER


@pytest.mark.parametrize(
    "data",
    [
        [],
        {},
        {**state_to_data(BURGER), "burnt": True},
        {**state_to_data(BURGER), "places": "table"},
        {**state_to_data(BURGER), "places": {"lettuce": "table"}},
        {**state_to_data(BURGER), "cut": 1},
        {**state_to_data(BURGER), "places": {**state_to_data(BURGER)["places"], "patty": "sink"}},
    ],
)
def test_data_of_no_state_is_refused(data: Any) -> None:
    with pytest.raises(ConfigurationError, match="expected"):
        state_from_data(data)

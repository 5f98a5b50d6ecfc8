"""The predicates in which the simulator itself describes a state.

They are what a programmer of such a simulator would write down; whether something lies on an item
is not among them, so they alone do not say when a skill works.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from skillwrapper.domains.burger.states import HAND, ITEMS, STATIONS, TABLE, BurgerState
from skillwrapper.symbols.predicates import Predicate

ROBOT: Final = "robot"

SYSTEM_PREDICATES: Final = (
    Predicate("hand_empty", ("robot",), "The robot holds nothing."),
    Predicate("holding", ("robot", "pickupable"), "The robot holds the ingredient."),
    Predicate("on_table", ("pickupable",), "The ingredient lies directly on a table."),
    Predicate(
        "on_station",
        ("pickupable", "station"),
        "The ingredient lies directly on the station, with no other ingredient between.",
    ),
    Predicate("station_empty", ("station",), "Nothing lies on the station."),
    Predicate(
        "stacked_on",
        ("pickupable", "pickupable"),
        "The first ingredient lies directly on the second.",
    ),
    Predicate("is_cut", ("cuttable",), "The ingredient has been cut into pieces."),
    Predicate("is_cooked", ("cookable",), "The ingredient has been cooked."),
)


def system_atoms(state: BurgerState) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The atoms of ``SYSTEM_PREDICATES`` that are true in a state."""
    if state.held is None:
        yield "hand_empty", (ROBOT,)
    for station in STATIONS:
        if state.item_on(station) is None:
            yield "station_empty", (station,)
    for item, place in zip(ITEMS, state.places, strict=True):
        if place == HAND:
            yield "holding", (ROBOT, item)
        elif place == TABLE:
            yield "on_table", (item,)
        elif place in STATIONS:
            yield "on_station", (item, place)
        else:
            yield "stacked_on", (item, place)
    if state.cut:
        yield "is_cut", ("lettuce",)
    if state.cooked:
        yield "is_cooked", ("patty",)

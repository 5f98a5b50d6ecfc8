"""A model of the burger kitchen written by hand: a baseline, exact on all reachable states."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from skillwrapper.domains.burger.states import HAND, ITEMS, STATIONS, TABLE, BurgerState
from skillwrapper.symbols.files import read_model
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.predicates import Atom
from skillwrapper.world.domain import load_domain

_FOLDER = Path(__file__).parent
_ROBOT = "robot"


def expert_model() -> AbstractModel:
    """The expert's predicates and operators, from ``expert_model.json``."""
    return read_model(_FOLDER / "expert_model.json", load_domain(_FOLDER / "domain.yaml"))


def expert_atoms(state: BurgerState) -> Iterator[Atom]:
    """The ground atoms of the expert's predicates that are true in a state."""
    if state.held is None:
        yield Atom("hand_empty", (_ROBOT,))
    for item in ITEMS:
        if state.item_on(item) is None:
            yield Atom("nothing_on", (item,))
    for station in STATIONS:
        if state.item_on(station) is None:
            yield Atom("station_free", (station,))
    for item, place in zip(ITEMS, state.places, strict=True):
        if place == HAND:
            yield Atom("holding", (_ROBOT, item))
        elif place in STATIONS:
            yield Atom("on_station", (item, place))
        elif place != TABLE:
            yield Atom("stacked_on", (item, place))
    if state.cut:
        yield Atom("is_cut", ("lettuce",))
    if state.cooked:
        yield Atom("is_cooked", ("patty",))

"""The states of the burger kitchen: where everything is and what became of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from skillwrapper.errors import ConfigurationError

ITEMS: Final = ("lettuce", "patty", "topbun", "bottombun")
STATIONS: Final = ("stove", "board")
TABLE: Final = "table"
"""The place of an item on the table where it started; every item has a table of its own."""
HAND: Final = "hand"
"""The place of an item that the robot holds."""


@dataclass(frozen=True, order=True)
class BurgerState:
    """One state of the kitchen.

    Attributes:
        places: for each of ``ITEMS``, what it is directly on: ``TABLE``, a station or another
            item; or ``HAND``.
        cut: whether the lettuce is cut.
        cooked: whether the patty is cooked.

    Raises:
        ConfigurationError: if things cannot be so.
    """

    places: tuple[str, ...] = (TABLE,) * len(ITEMS)
    cut: bool = False
    cooked: bool = False

    def __post_init__(self) -> None:
        if len(self.places) != len(ITEMS):
            raise ConfigurationError(f"expected {len(ITEMS)} places, got {len(self.places)}")
        for place in self.places:
            if place not in (TABLE, HAND, *STATIONS, *ITEMS):
                known = ", ".join((TABLE, HAND, *STATIONS, *ITEMS))
                raise ConfigurationError(f"expected a place of {known}; got '{place}'")
        for place in (HAND, *STATIONS, *ITEMS):
            if self.places.count(place) > 1:
                raise ConfigurationError(f"expected at most one item at '{place}', got several")
        for item in ITEMS:
            self._check_support(item)

    @property
    def held(self) -> str | None:
        """The item in the hand."""
        return self.item_on(HAND)

    def place_of(self, item: str) -> str:
        """What an item is directly on, or ``HAND``."""
        return self.places[ITEMS.index(item)]

    def item_on(self, place: str) -> str | None:
        """The item directly at a station, on an item or in the hand; None if there is none."""
        return ITEMS[self.places.index(place)] if place in self.places else None

    def stack_from(self, item: str) -> tuple[str, ...]:
        """An item and everything on it, from the lowest to the highest."""
        above = self.item_on(item)
        return (item,) if above is None else (item, *self.stack_from(above))

    def moved(self, item: str, place: str) -> BurgerState:
        """The same state with one item elsewhere."""
        places = tuple(
            place if name == item else old for name, old in zip(ITEMS, self.places, strict=True)
        )
        return BurgerState(places, self.cut, self.cooked)

    def _check_support(self, item: str) -> None:
        """Every item must lie on furniture in the end, and nothing on a held one."""
        place = self.place_of(item)
        if place in ITEMS and self.place_of(place) == HAND:
            raise ConfigurationError(f"expected nothing on the held {place}, got the {item}")
        passed = {item}
        while place in ITEMS:
            if place in passed:
                raise ConfigurationError(f"expected the {item} to lie on furniture, got a circle")
            passed.add(place)
            place = self.place_of(place)


def state_to_data(state: BurgerState) -> dict[str, Any]:
    """A plain description: ``{"places": {"lettuce": "table", ...}, "cut": ..., "cooked": ...}``."""
    places = dict(zip(ITEMS, state.places, strict=True))
    return {"places": places, "cut": state.cut, "cooked": state.cooked}


def state_from_data(data: Mapping[str, Any]) -> BurgerState:
    """The state of such a description.

    Raises:
        ConfigurationError: if it is not one of a state.
    """
    if not isinstance(data, Mapping) or set(data) != {"places", "cut", "cooked"}:
        got = sorted(map(str, data)) if isinstance(data, Mapping) else repr(data)
        raise ConfigurationError(f"expected a state with places, cut and cooked; got {got}")
    places, cut, cooked = data["places"], data["cut"], data["cooked"]
    if not isinstance(places, Mapping) or set(places) != set(ITEMS):
        raise ConfigurationError(f"expected a place for each of {', '.join(ITEMS)}; got {places!r}")
    if not isinstance(cut, bool) or not isinstance(cooked, bool):
        raise ConfigurationError(
            f"expected true or false for cut and cooked; got {cut!r} and {cooked!r}"
        )
    return BurgerState(tuple(str(places[item]) for item in ITEMS), cut, cooked)

"""Why some states of the kitchen cannot be reached from others, and what states are alike.

For choosing test problems only. That a problem is impossible is proven by search; what stands here
says why, and is silent where it does not know.
"""

from __future__ import annotations

from typing import Final

from skillwrapper.domains.burger.states import ITEMS, STATIONS, TABLE, BurgerState
from skillwrapper.domains.package import Impossibility


def impossibility(start: BurgerState, goal: BurgerState) -> tuple[str, str] | None:
    """Kind and reason if exactly one known reason keeps a goal from being reached."""
    found = [*_irreversible(start, goal)]
    if not found and TABLE not in start.places:
        found += _two_places(start, goal)
    return found[0] if len(found) == 1 else None


IMPOSSIBILITY: Final = Impossibility(
    ("back_on_table", "no_free_place", "out_of_reach", "raw_beneath", "uncut", "uncooked"),
    impossibility,
)
"""What is known of it, for the domain package."""


def structure(state: BurgerState) -> str:
    """What is built, whatever it is built of: heights of the stacks, and what is done."""
    heights = [
        f"{place} {len(state.stack_from(item))}"
        for place in STATIONS
        if (item := state.item_on(place)) is not None
    ]
    tables = sorted(
        len(state.stack_from(item))
        for item, place in zip(ITEMS, state.places, strict=True)
        if place == TABLE
    )
    marks = [m for m, is_so in (("cut", state.cut), ("cooked", state.cooked)) if is_so]
    held = ["held"] if state.held else []
    return ", ".join([*heights, *(f"table {height}" for height in tables), *held, *marks])


def _irreversible(start: BurgerState, goal: BurgerState) -> list[tuple[str, str]]:
    found = []
    for item in ITEMS:
        if start.place_of(item) != TABLE and goal.place_of(item) == TABLE:
            reason = f"the {item} has left its table, and nothing can be put back on a table"
            found.append(("back_on_table", reason))
    if start.cut and not goal.cut:
        found.append(("uncut", "the lettuce is cut, and nothing makes it whole again"))
    if start.cooked and not goal.cooked:
        above = goal.item_on("patty")
        if above is None:
            found.append(("uncooked", "the patty is cooked, and nothing makes it raw again"))
        else:
            reason = f"the patty is cooked already; under the {above} the goal has a raw one"
            found.append(("raw_beneath", reason))
    return found


def _two_places(start: BurgerState, goal: BurgerState) -> list[tuple[str, str]]:
    """With all tables empty there are two stacks; what leaves one goes on top of the other."""
    if _row(start) != _row(goal):
        reason = "all tables are empty: with two stacks only, their order cannot be changed"
        return [("no_free_place", reason)]
    for item, station, wanted in (
        ("lettuce", "board", goal.cut and not start.cut),
        ("patty", "stove", goal.cooked and not start.cooked),
    ):
        if wanted and _row(start)[0 if station == STATIONS[0] else -1] != item:
            reason = (
                f"with two stacks only, the {item} cannot become the lowest one on the {station}"
            )
            return [("out_of_reach", reason)]
    return []


def _row(state: BurgerState) -> tuple[str, ...]:
    """The items from the stove up, over the hand, and down to the board; no skill changes it."""
    stacks = [
        state.stack_from(item) if (item := state.item_on(place)) is not None else ()
        for place in STATIONS
    ]
    hand = (state.held,) if state.held else ()
    return (*stacks[0], *hand, *reversed(stacks[1]))

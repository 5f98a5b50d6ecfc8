"""When the skills of the burger kitchen work, and what they change."""

from __future__ import annotations

from dataclasses import replace

from skillwrapper.domains.burger.states import HAND, BurgerState
from skillwrapper.errors import InternalError
from skillwrapper.world.skills import SkillInstance


def obstacle(state: BurgerState, instance: SkillInstance) -> str | None:
    """Why a skill instance fails in a state, in words; None if it succeeds."""
    match (instance.skill, instance.arguments):
        case "Pick", (_, item):
            return _hand_full(state) or _covered(state, item)
        case "Place", (_, item, station):
            return _not_held(state, item) or _occupied(state, station)
        case "Stack", (_, upper, lower):
            return _not_held(state, upper) or _covered(state, lower)
        case "Cut", (_, item):
            done = f"the {item} is already cut" if state.cut else None
            return done or _not_ready(state, item, "board")
        case "Cook", (_, item):
            done = f"the {item} is already cooked" if state.cooked else None
            return done or _not_ready(state, item, "stove")
    raise InternalError(f"the burger kitchen has no rule for {instance}; please report it")


def effect(state: BurgerState, instance: SkillInstance) -> BurgerState:
    """The state after a skill instance that succeeds."""
    match (instance.skill, instance.arguments):
        case "Pick", (_, item):
            return state.moved(item, HAND)
        case (("Place" | "Stack"), (_, item, place)):
            return state.moved(item, place)
        case "Cut", _:
            return replace(state, cut=True)
        case "Cook", _:
            return replace(state, cooked=True)
    raise InternalError(f"the burger kitchen has no rule for {instance}; please report it")


def _hand_full(state: BurgerState) -> str | None:
    return None if state.held is None else f"the hand is not empty: it holds the {state.held}"


def _not_held(state: BurgerState, item: str) -> str | None:
    return None if state.held == item else f"the robot does not hold the {item}"


def _covered(state: BurgerState, item: str) -> str | None:
    above = state.item_on(item)
    return None if above is None else f"the {above} lies on the {item}"


def _occupied(state: BurgerState, station: str) -> str | None:
    item = state.item_on(station)
    return None if item is None else f"the {item} lies on the {station} already"


def _not_ready(state: BurgerState, item: str, station: str) -> str | None:
    """Cutting and cooking ask for the same: a free hand, the right place, nothing on top."""
    if state.place_of(item) != station:
        return f"the {item} does not lie on the {station}"
    return _hand_full(state) or _covered(state, item)

"""When the skills of the two arms work, and what they change; most of it is for good."""

from __future__ import annotations

from dataclasses import replace

from skillwrapper.domains.kuka.states import (
    CLEAN,
    COATED,
    IN_HAND,
    IN_HOLDER,
    ON_TABLE,
    USED,
    KukaState,
)
from skillwrapper.errors import InternalError
from skillwrapper.world.skills import SkillInstance


def obstacle(state: KukaState, instance: SkillInstance) -> str | None:
    """Why a skill instance fails in a state, in words; None if it succeeds."""
    match instance.skill:
        case "LeftArmPick":
            return "the left hand is full: it holds the jar" if state.jar_held else None
        case "RightArmPick":
            return _not_in_holder(state)
        case "Open":
            full = state.knife == IN_HAND
            return (
                _jar_not_held(state)
                or ("the jar is open already" if state.opened else None)
                or ("the right hand is full: it holds the knife" if full else None)
            )
        case "Scoop":
            return _knife_not_held(state) or _no_jar_to_scoop_from(state) or _not_clean(state)
        case "Spread":
            bare = None if state.blade == COATED else "there is nothing on the knife to spread"
            return _knife_not_held(state) or bare
        case "Drop":
            return _knife_not_held(state)
    raise InternalError(f"the two arms have no rule for {instance}; please report it")


def effect(state: KukaState, instance: SkillInstance) -> KukaState:
    """The state after a skill instance that succeeds."""
    match instance.skill:
        case "LeftArmPick":
            return replace(state, jar_held=True)
        case "RightArmPick":
            return replace(state, knife=IN_HAND)
        case "Open":
            return replace(state, opened=True)
        case "Scoop":
            return replace(state, blade=COATED)
        case "Spread":
            return replace(state, blade=USED)
        case "Drop":
            return replace(state, knife=ON_TABLE)
    raise InternalError(f"the two arms have no rule for {instance}; please report it")


def _not_in_holder(state: KukaState) -> str | None:
    if state.knife == IN_HAND:
        return "the right hand is full: it holds the knife"
    flat = "the knife lies flat on the table, where fingers cannot get under it"
    return None if state.knife == IN_HOLDER else flat


def _knife_not_held(state: KukaState) -> str | None:
    return None if state.knife == IN_HAND else "the right hand does not hold the knife"


def _jar_not_held(state: KukaState) -> str | None:
    return None if state.jar_held else "the left hand does not hold the jar"


def _no_jar_to_scoop_from(state: KukaState) -> str | None:
    return _jar_not_held(state) or (None if state.opened else "the jar is closed")


def _not_clean(state: KukaState) -> str | None:
    return None if state.blade == CLEAN else "there is peanut butter on the knife already"

"""When the skills of the table work, and what they change: the paper's expert model."""

from __future__ import annotations

from dataclasses import replace

from skillwrapper.domains.panda.states import PandaState
from skillwrapper.errors import InternalError
from skillwrapper.world.skills import SkillInstance


def obstacle(state: PandaState, instance: SkillInstance) -> str | None:
    """Why a skill instance fails in a state, in words; None if it succeeds."""
    match (instance.skill, instance.arguments):
        case "Pick", _:
            return None if state.held is None else f"the hand is full: it holds the {state.held}"
        case "Place", (_, thing):
            return _not_held(state, thing)
        case "Pour", (_, thing, container):
            full = f"the {container} is full already" if state.full else None
            return _not_held(state, thing) or full
        case "Stack", (_, thing, plate):
            dirty = f"the {plate} is dirty" if state.dirty else None
            return _not_held(state, thing) or _occupied(state, plate) or dirty
        case "Wipe", (_, thing, plate):
            clean = None if state.dirty else f"the {plate} is clean already"
            return _not_held(state, thing) or _occupied(state, plate) or clean
    raise InternalError(f"the table has no rule for {instance}; please report it")


def effect(state: PandaState, instance: SkillInstance) -> PandaState:
    """The state after a skill instance that succeeds."""
    match (instance.skill, instance.arguments):
        case "Pick", (_, thing):
            stacked = None if state.stacked == thing else state.stacked
            return replace(state, held=thing, stacked=stacked)
        case "Place", _:
            return replace(state, held=None)
        case "Pour", _:
            return replace(state, full=True)
        case "Stack", (_, thing, _):
            return replace(state, held=None, stacked=thing)
        case "Wipe", _:
            return replace(state, dirty=False)
    raise InternalError(f"the table has no rule for {instance}; please report it")


def _not_held(state: PandaState, thing: str) -> str | None:
    return None if state.held == thing else f"the robot does not hold the {thing}"


def _occupied(state: PandaState, plate: str) -> str | None:
    return None if state.stacked is None else f"the {state.stacked} stands on the {plate}"

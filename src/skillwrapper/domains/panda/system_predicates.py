"""The predicates in which the simulator itself describes a state."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from skillwrapper.domains.panda.states import MUG, PLATE, ROBOT, PandaState
from skillwrapper.symbols.predicates import Predicate

SYSTEM_PREDICATES: Final = (
    Predicate("holding", ("robot", "pickupable"), "The robot holds the thing."),
    Predicate("on_plate", ("pickupable", "plate"), "The thing stands on the plate."),
    Predicate("is_dirty", ("plate",), "Food sticks to the plate."),
    Predicate("is_full", ("container",), "The vessel is filled."),
)


def system_atoms(state: PandaState) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The atoms of ``SYSTEM_PREDICATES`` that are true in a state."""
    if state.held is not None:
        yield "holding", (ROBOT, state.held)
    if state.stacked is not None:
        yield "on_plate", (state.stacked, PLATE)
    if state.dirty:
        yield "is_dirty", (PLATE,)
    if state.full:
        yield "is_full", (MUG,)

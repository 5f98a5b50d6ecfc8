"""The predicates in which the simulator itself describes a state."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from skillwrapper.domains.kuka.states import (
    BREAD,
    COATED,
    IN_HAND,
    IN_HOLDER,
    JAR,
    KNIFE,
    ROBOT,
    USED,
    KukaState,
)
from skillwrapper.symbols.predicates import Predicate

SYSTEM_PREDICATES: Final = (
    Predicate("in_left_hand", ("openable", "robot"), "The jar is in the left hand."),
    Predicate("in_right_hand", ("utensil", "robot"), "The knife is in the right hand."),
    Predicate("in_holder", ("utensil",), "The knife stands in its holder."),
    Predicate("is_open", ("openable",), "The lid is off."),
    Predicate("is_coated", ("utensil",), "Peanut butter covers the blade."),
    Predicate("is_used", ("utensil",), "Traces of peanut butter are left on the blade."),
    Predicate("is_spread", ("food",), "There is peanut butter on the bread."),
)


def system_atoms(state: KukaState) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The atoms of ``SYSTEM_PREDICATES`` that are true in a state."""
    if state.jar_held:
        yield "in_left_hand", (JAR, ROBOT)
    if state.knife == IN_HAND:
        yield "in_right_hand", (KNIFE, ROBOT)
    if state.knife == IN_HOLDER:
        yield "in_holder", (KNIFE,)
    if state.opened:
        yield "is_open", (JAR,)
    if state.blade == COATED:
        yield "is_coated", (KNIFE,)
    if state.blade == USED:
        yield "is_used", (KNIFE,)
    if state.spread:
        yield "is_spread", (BREAD,)

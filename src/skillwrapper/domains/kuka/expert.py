"""A model of the two arms written by hand after the paper's: a baseline, exact on all states."""

from __future__ import annotations

from collections.abc import Iterator

from skillwrapper.domains.kuka.states import (
    BREAD,
    CLEAN,
    COATED,
    IN_HAND,
    IN_HOLDER,
    JAR,
    KNIFE,
    ROBOT,
    KukaState,
)
from skillwrapper.symbols.predicates import Atom


def expert_atoms(state: KukaState) -> Iterator[Atom]:
    """The ground atoms of the expert's predicates that are true in a state, of all objects."""
    left, right = (Atom("left_holds", (ROBOT, JAR)), Atom("right_holds", (ROBOT, KNIFE)))
    yield left if state.jar_held else Atom("left_hand_empty", (ROBOT,))
    yield right if state.knife == IN_HAND else Atom("right_hand_empty", (ROBOT,))
    if state.knife == IN_HOLDER:
        yield Atom("in_holder", (KNIFE,))
    if state.opened:
        yield Atom("is_open", (JAR,))
    if state.blade == CLEAN:
        yield Atom("is_clean", (KNIFE,))
    if state.blade == COATED:
        yield Atom("is_coated", (KNIFE,))
    if state.spread:
        yield Atom("is_covered", (BREAD,))

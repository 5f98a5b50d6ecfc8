"""A model of the table written by hand after the paper's: a baseline, exact on all states."""

from __future__ import annotations

from collections.abc import Iterator

from skillwrapper.domains.panda.states import MUG, PLATE, ROBOT, PandaState
from skillwrapper.symbols.predicates import Atom


def expert_atoms(state: PandaState) -> Iterator[Atom]:
    """The ground atoms of the expert's predicates that are true in a state, of all objects."""
    if state.held is None:
        yield Atom("hand_empty", (ROBOT,))
    else:
        yield Atom("holding", (ROBOT, state.held))
    if state.stacked is None:
        yield Atom("plate_empty", (PLATE,))
    else:
        yield Atom("is_on_top", (state.stacked, PLATE))
    if not state.dirty:
        yield Atom("is_clean", (PLATE,))
    if state.full:
        yield Atom("is_full", (MUG,))

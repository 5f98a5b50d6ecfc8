"""Why some states of the table cannot be reached from others, and what states are alike.

For choosing test problems only. That a problem is impossible is proven by search.
"""

from __future__ import annotations

from typing import Final

from skillwrapper.domains.package import Impossibility
from skillwrapper.domains.panda.states import PandaState


def impossibility(start: PandaState, goal: PandaState) -> tuple[str, str] | None:
    """Kind and reason if exactly one known reason keeps a goal from being reached."""
    found = []
    if start.full and not goal.full:
        found.append(("emptied", "the mug is full, and nothing empties it"))
    if goal.dirty and not start.dirty:
        found.append(("soiled", "the plate is clean, and nothing makes it dirty"))
    return found[0] if len(found) == 1 else None


IMPOSSIBILITY: Final = Impossibility(("emptied", "soiled"), impossibility)
"""What is known of it, for the domain package."""


def structure(state: PandaState) -> str:
    """What is where, whatever it is."""
    parts = {
        "held": state.held,
        "stacked": state.stacked,
        "dirty": state.dirty,
        "full": state.full,
    }
    return ", ".join(name for name, value in parts.items() if value) or "as at the start"

"""Why some states of the two arms cannot be reached from others, and what states are alike.

For choosing test problems only. That a problem is impossible is proven by search.
"""

from __future__ import annotations

from typing import Final

from skillwrapper.domains.kuka.states import CLEAN, COATED, IN_HAND, IN_HOLDER, USED, KukaState
from skillwrapper.domains.package import Impossibility

_PLACES: Final = (IN_HOLDER, IN_HAND)
_BLADES: Final = (CLEAN, COATED, USED)


def impossibility(start: KukaState, goal: KukaState) -> tuple[str, str] | None:
    """Kind and reason if exactly one known reason keeps a goal from being reached."""
    found = []
    if start.jar_held and not goal.jar_held:
        found.append(("released", "the left hand holds the jar, and nothing makes it let go"))
    elif start.opened and not goal.opened:
        found.append(("closed", "the jar is open, and nothing closes it"))
    if start.knife not in _PLACES and goal.knife in _PLACES:
        found.append(("lifted", "the knife lies on the table, and nothing lifts it from there"))
    elif start.knife == IN_HAND and goal.knife == IN_HOLDER:
        found.append(("put back", "the knife has left its holder, and nothing puts it back"))
    if _BLADES.index(goal.blade) < _BLADES.index(start.blade):
        found.append(("cleaned", "there is peanut butter on the knife, and nothing cleans it"))
    elif goal.blade != start.blade and start.knife not in _PLACES and not found:
        found.append(("too late", "the knife lies on the table, so nothing gets onto its blade"))
    if goal.opened and not start.opened and _holds_from_start_to_end(start, goal):
        found.append(("hand full", "the right hand must hold the knife all the time, so not open"))
    return found[0] if len(found) == 1 else None


IMPOSSIBILITY: Final = Impossibility(
    ("released", "closed", "lifted", "put back", "cleaned", "too late", "hand full"), impossibility
)
"""What is known of it, for the domain package."""


def structure(state: KukaState) -> str:
    """What is held, and what was done."""
    parts = {
        "jar held": state.jar_held,
        "open": state.opened,
        f"knife in {state.knife}": state.knife != IN_HOLDER,
        state.blade: state.blade != CLEAN,
    }
    return ", ".join(name for name, is_so in parts.items() if is_so) or "as at the start"


def _holds_from_start_to_end(start: KukaState, goal: KukaState) -> bool:
    return start.knife == IN_HAND and (goal.knife == IN_HAND or goal.blade != CLEAN)

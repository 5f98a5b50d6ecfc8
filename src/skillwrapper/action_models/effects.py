"""Effects: what successes changed, under add-after-delete semantics.

Where two parameters stand for one object, several lifted atoms say the same of it; of an atom that
is both deleted and added then, the addition counts. So only views in which an atom stands alone
tell surely what happens to it, and the others are explained by as little more as possible.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.action_models.models import Condition, Effect
from skillwrapper.action_models.skeleton import LiftedAtom
from skillwrapper.action_models.views import Bits, ViewTable, some


@dataclass(frozen=True, eq=False)
class _Changes:
    """What successes show of every atom; all (views, atoms).

    Attributes:
        alone: whether an atom stands alone.
        before: whether it was true before.
        after: whether it was true after.
        same: the number of the first atom that says the same.
    """

    alone: Bits
    before: Bits
    after: Bits
    same: NDArray[np.intp]


def find_effects(table: ViewTable, atoms: Sequence[LiftedAtom]) -> tuple[Effect, ...]:
    """The effects of an action, sorted; conditional ones where one view has a change and another,
    in which it would have been one too, has not."""
    done = table.success
    seen = _Changes(table.alone[done], table.before[done], table.after[done], table.same[done])
    found: list[Effect] = []
    adds = _added(seen)
    adds |= _restored(seen, adds)
    deletes = _deleted(seen, adds)
    for positive, chosen in ((True, adds), (False, deletes)):
        for number in np.flatnonzero(chosen).tolist():
            change = Condition(atoms[number], positive)
            found.append(Effect(change, _when(seen, atoms, number, positive=positive)))
    return tuple(sorted(found))


def _added(seen: _Changes) -> Bits:
    """The atoms that some success surely made true, and what else explains the others."""
    became = ~seen.before & seen.after
    surely = some(became & seen.alone)
    return _explain(became & ~seen.alone, seen, surely, ~some(~seen.after))


def _restored(seen: _Changes, adds: Bits) -> Bits:
    """What must be added too, as it says the same as what is deleted and yet stayed true."""
    ceased = some(seen.before & ~seen.after & seen.alone)
    deletes = ceased & ~some(seen.before & seen.after & seen.alone)
    stayed = seen.before & seen.after & ~seen.alone & deletes
    return _explain(stayed, seen, adds, ~some(~seen.after) & ~deletes)


def _deleted(seen: _Changes, adds: Bits) -> Bits:
    """The same for what became false; what stayed true without an addition is not deleted."""
    ceased = seen.before & ~seen.after
    surely = some(ceased & seen.alone)
    stayed = some(seen.after & ~_shares(seen, adds))
    return _explain(ceased & ~seen.alone, seen, surely, ~stayed & ~adds)


def _shares(seen: _Changes, chosen: Bits) -> Bits:
    """Whether an atom says the same as a chosen one (views, atoms)."""
    first = np.zeros(seen.same.shape, dtype=bool)
    rows = np.arange(len(seen.same))[:, np.newaxis]
    np.logical_or.at(first, (rows, seen.same[:, chosen]), True)
    shares: Bits = np.take_along_axis(first, seen.same, axis=1)
    return shares


def _explain(changed: Bits, seen: _Changes, surely: Bits, possible: Bits) -> Bits:
    """Known atoms, and for every shared change that none of them explains all possible ones."""
    chosen = surely.copy()
    for view, number in np.argwhere(changed).tolist():
        sharing = seen.same[view] == seen.same[view, number]
        if not (sharing & surely).any():
            chosen |= sharing & possible
    return chosen


def _when(
    seen: _Changes, atoms: Sequence[LiftedAtom], number: int, *, positive: bool
) -> tuple[Condition, ...]:
    """Under what condition an atom changes; nothing if it always does."""
    ready = seen.alone[:, number] & (seen.before[:, number] != positive)
    changed = ready & (seen.after[:, number] == positive)
    unchanged = ready & (seen.after[:, number] != positive)
    if not unchanged.any() or not changed.any():
        return ()
    held = seen.before[changed]
    candidates = [(i, True) for i in np.flatnonzero(held.all(axis=0)).tolist()]
    candidates += [(i, False) for i in np.flatnonzero(~held.any(axis=0)).tolist()]
    others = seen.before[unchanged]
    chosen: list[tuple[int, bool]] = []
    left = np.ones(len(others), dtype=bool)
    while left.any():
        excluded = [int((others[left, i] != truth).sum()) for i, truth in candidates]
        best = int(np.argmax(excluded)) if excluded else 0
        if not excluded or excluded[best] == 0:
            break  # no literal over the arguments tells them apart
        chosen.append(candidates[best])
        left &= others[:, candidates[best][0]] == candidates[best][1]
    return tuple(sorted(Condition(atoms[i], truth) for i, truth in chosen))

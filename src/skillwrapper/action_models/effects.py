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
from skillwrapper.action_models.views import UNKNOWN_BIT, Bits, ViewTable, some

_Literal = tuple[int, bool]
"""The number of an atom, and whether it must be true or false."""

_Values = NDArray[np.uint8]
"""1 where an atom is true, 0 where it is false, and ``UNKNOWN_BIT`` (views, atoms)."""


@dataclass(frozen=True, eq=False)
class _Changes:
    """What successes show of every atom; all (views, atoms).

    Attributes:
        alone: whether an atom stands alone.
        before: whether it was true before.
        after: whether it was true after.
        false_before: whether it was false before; neither if that is unknown.
        false_after: whether it was false after.
        same: the number of the first atom that says the same.
    """

    alone: Bits
    before: Bits
    after: Bits
    false_before: Bits
    false_after: Bits
    same: NDArray[np.intp]


def find_effects(table: ViewTable, atoms: Sequence[LiftedAtom]) -> tuple[Effect, ...]:
    """The effects of an action, sorted; conditional ones where one view has a change and another,
    in which it would have been one too, has not."""
    done = table.success
    seen = _Changes(
        table.alone[done],
        table.before[done],
        table.after[done],
        table.false_before[done],
        table.false_after[done],
        table.same[done],
    )
    found: list[Effect] = []
    adds = _added(seen)
    adds |= _restored(seen, adds)
    deletes = _deleted(seen, adds)
    for positive, chosen in ((True, adds), (False, deletes)):
        for number in np.flatnonzero(chosen).tolist():
            change = Condition(atoms[number], positive)
            for literals in _when(seen, number, positive=positive):
                when = sorted(Condition(atoms[i], truth) for i, truth in literals)
                found.append(Effect(change, tuple(when)))
    return tuple(sorted(found))


def count_unexplained(
    table: ViewTable, atoms: Sequence[LiftedAtom], effects: Sequence[Effect]
) -> int:
    """After how many different successes something else is true than effects say."""
    done = table.success
    before, same = table.before[done], table.same[done]
    values = _values(before, table.false_before[done])
    number_of = {atom: number for number, atom in enumerate(atoms)}
    made = {True: np.zeros_like(before), False: np.zeros_like(before)}
    for effect in effects:
        when = [(number_of[condition.atom], condition.holds) for condition in effect.when]
        rows = np.flatnonzero(_met(values, when))
        made[effect.change.holds][rows, same[rows, number_of[effect.change.atom]]] = True
    added, deleted = (np.take_along_axis(made[x], same, axis=1) for x in (True, False))
    lost = ((before & ~deleted) | added) & table.false_after[done]
    gained = ((table.false_before[done] | deleted) & ~added) & table.after[done]
    return int((lost | gained).any(axis=1).sum())


def _added(seen: _Changes) -> Bits:
    """The atoms that some success surely made true, and what else explains the others."""
    became = seen.false_before & seen.after
    surely = some(became & seen.alone)
    return _explain(became & ~seen.alone, seen, surely, ~some(seen.false_after))


def _restored(seen: _Changes, adds: Bits) -> Bits:
    """What must be added too, as it says the same as what is deleted and yet stayed true."""
    ceased = some(seen.before & seen.false_after & seen.alone)
    deletes = ceased & ~some(seen.before & seen.after & seen.alone)
    stayed = seen.before & seen.after & ~seen.alone & deletes
    return _explain(stayed, seen, adds, ~some(seen.false_after) & ~deletes)


def _deleted(seen: _Changes, adds: Bits) -> Bits:
    """The same for what became false; what stayed true without an addition is not deleted."""
    ceased = seen.before & seen.false_after
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


def _when(seen: _Changes, number: int, *, positive: bool) -> list[tuple[_Literal, ...]]:
    """Under what conditions an atom changes, any of which is enough; one without literals: always.

    An addition did not come about wherever the atom was false after; a deletion, where it was true
    before and after, as one that is undone by an addition is not seen.

    If no literals over the arguments tell some changes from what did not change, the condition
    that is found takes these in.
    """
    values, alone = _values(seen.before, seen.false_before), seen.alone[:, number]
    if positive:
        changed = values[alone & seen.false_before[:, number] & seen.after[:, number]]
        unchanged = values[alone & seen.false_after[:, number]]
    else:
        changed = values[alone & seen.before[:, number] & seen.false_after[:, number]]
        unchanged = values[alone & seen.before[:, number] & seen.after[:, number]]
    if not len(unchanged) or not len(changed):
        return [()]
    together, left = _conjunction(changed, unchanged)
    if not left:
        return [together]
    found = []
    while len(changed):
        condition, _ = _conjunction(changed[:1], unchanged, prefer=changed)
        found.append(condition)
        changed = changed[~_met(changed, condition)]
    return found


def _conjunction(
    changed: _Values, unchanged: _Values, prefer: _Values | None = None
) -> tuple[tuple[_Literal, ...], bool]:
    """Literals that hold in all that changed and, together, in little of what did not.

    Args:
        changed: what was so before each change (views, atoms).
        unchanged: what was so before where there was none (views, atoms).
        prefer: changes of which as many as possible should meet the literals too.

    Returns:
        The literals, and whether something is left in which they hold and nothing changed.
    """
    candidates = [
        (i, truth)
        for truth in (True, False)
        for i in np.flatnonzero((changed == truth).all(axis=0)).tolist()
    ]
    prefer = changed if prefer is None else prefer
    chosen: list[_Literal] = []
    while len(unchanged):
        worth = [
            (int((prefer[:, i] == truth).sum()) if excluded else -1, excluded)
            for i, truth in candidates
            for excluded in [int((unchanged[:, i] == (not truth)).sum())]
        ]
        best = max(range(len(candidates)), key=worth.__getitem__, default=None)
        if best is None or worth[best][1] == 0:
            return tuple(chosen), True
        number, truth = candidates[best]
        chosen.append((number, truth))
        unchanged = unchanged[unchanged[:, number] != (not truth)]
        prefer = prefer[prefer[:, number] == truth]
    return tuple(chosen), False


def _values(true: Bits, false: Bits) -> _Values:
    """What is so, in one array (views, atoms)."""
    return np.where(true, 1, np.where(false, 0, UNKNOWN_BIT)).astype(np.uint8)


def _met(before: _Values, condition: Sequence[_Literal]) -> Bits:
    """In which views literals are known to hold (views,)."""
    held = np.ones(len(before), dtype=bool)
    for number, truth in condition:
        held &= before[:, number] == truth
    return held

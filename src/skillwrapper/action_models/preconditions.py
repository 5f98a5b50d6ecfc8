"""Preconditions: what held before every success, bounded from above by what failed.

Whatever was false before a success is no precondition. Without failures nothing more is known,
and all that is left counts: the model is sound. A failure must violate a precondition; so what
alone explains a failure is needed, and what was often violated and never alone is given up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillwrapper.action_models.models import Condition
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton import LiftedAtom
from skillwrapper.action_models.views import ActionViews, Bits, ViewTable, some

_EQUAL = "="


@dataclass(frozen=True)
class Preconditions:
    """What must hold before an action.

    Attributes:
        needed: the preconditions, sorted.
        refuted: what always held, and was given up because of failures; sorted.
        unexplained: how many different failures violate nothing that always held.
    """

    needed: tuple[Condition, ...]
    refuted: tuple[Condition, ...]
    unexplained: int


def find_preconditions(
    views: ActionViews, table: ViewTable, seen: frozenset[str], settings: ActionModelSettings
) -> Preconditions:
    """The preconditions of an action that succeeded at least once.

    Args:
        views: the action.
        table: its views.
        seen: the predicates of which anything was ever true; that others were false, as they
            always were, says nothing.
        settings: what preconditions may say.
    """
    conditions, violated = _candidates(views, table)
    possible = ~some(violated[table.success])
    conditions = [c for c, left in zip(conditions, possible, strict=True) if left]
    failures = violated[~table.success][:, possible]
    allowed = _announced(conditions, views, seen, settings)
    if settings.negatives != "none":
        allowed |= _cover(failures[~failures[:, allowed].any(axis=1)])
    kept = allowed & ~_given_up(failures[:, allowed], allowed, settings.enough_failures)
    return Preconditions(
        tuple(sorted(c for c, keep in zip(conditions, kept, strict=True) if keep)),
        tuple(
            sorted(
                c
                for c, own, keep in zip(conditions, allowed, kept, strict=True)
                if own and not keep
            )
        ),
        int((~failures.any(axis=1)).sum()),
    )


def _candidates(views: ActionViews, table: ViewTable) -> tuple[list[Condition], Bits]:
    """All literals, positive ones first, and whether views violate them (views, literals)."""
    names = [p.name for p in views.action.parameters]
    different = [LiftedAtom(_EQUAL, (names[i], names[j])) for i, j in views.pairs]
    conditions = [
        *(Condition(atom) for atom in views.atoms),
        *(Condition(atom, holds=False) for atom in (*views.atoms, *different)),
    ]
    return conditions, np.hstack([~table.before, table.before, table.equal])


def _announced(
    conditions: list[Condition],
    views: ActionViews,
    seen: frozenset[str],
    settings: ActionModelSettings,
) -> Bits:
    """The literals that may be preconditions without a failure as their reason."""
    declared = settings.negatives == "declared"
    negative = settings.negatives == "all" or (declared and views.skeleton.has_negatives)
    unequal = settings.negatives == "all" or (declared and views.skeleton.has_equality)

    def is_announced(condition: Condition) -> bool:
        if condition.holds:
            return True
        predicate = condition.atom.predicate
        return unequal if predicate == _EQUAL else negative and predicate in seen

    return np.array([is_announced(condition) for condition in conditions], dtype=bool)


def _given_up(failures: Bits, allowed: Bits, enough: int) -> Bits:
    """Which of all literals failures speak against; ``failures`` are by allowed ones alone."""
    found = np.zeros(len(allowed), dtype=bool)
    explained = failures[failures.any(axis=1)]
    needed = _cover(explained)
    often = explained.sum(axis=0) >= enough
    found[allowed] = often & ~needed
    return found


def _cover(failures: Bits) -> Bits:
    """Few literals of which every failure violates one (literals,).

    First those that alone explain a failure; then, as long as a failure is left, the literal that
    explains most of those left, the first of equals.
    """
    chosen = np.zeros(failures.shape[1], dtype=bool)
    chosen |= some(failures[failures.sum(axis=1) == 1])
    left = failures[failures.any(axis=1) & ~failures[:, chosen].any(axis=1)]
    while len(left):
        best = int(np.argmax(left.sum(axis=0)))
        chosen[best] = True
        left = left[~left[:, best]]
    return chosen

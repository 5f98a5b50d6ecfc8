"""Preconditions: what held before every success, bounded from above by what failed.

Whatever was false before a success is no precondition, and neither is what was never seen to hold
before one (D10; ``cautious`` keeps it): the two differ only where states were missing. Without
failures nothing more is known, and all that is left counts: the model is sound. A failure must
violate a precondition, so what alone explains a failure is needed. What was violated in several
failures and never alone is given up, if it follows from what is likelier to be meant, in all states
that were seen (``witnesses``).
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from skillwrapper.action_models.background import Background
from skillwrapper.action_models.models import Condition
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton import LiftedAtom, Schema
from skillwrapper.action_models.views import ActionViews, Bits, ViewTable, some
from skillwrapper.action_models.witnesses import makes_no_difference, never_came_about

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
    views: ActionViews, table: ViewTable, background: Background, settings: ActionModelSettings
) -> Preconditions:
    """The preconditions of an action that succeeded at least once.

    Args:
        views: the action.
        table: its views.
        background: what the steps of all actions say.
        settings: what preconditions may say.
    """
    conditions, violated = _candidates(views, table)
    possible = ~some(violated[table.success])
    if not settings.cautious:
        possible &= some(_held(table)[table.success])
    conditions = [c for c, left in zip(conditions, possible, strict=True) if left]
    failures = violated[~table.success][:, possible]
    allowed = _announced(conditions, views, background.seen, settings)
    if settings.negatives != "none":
        allowed |= _cover(failures[~failures[:, allowed].any(axis=1)])
        allowed |= _unheard_of(conditions, views.action, background)
    always = [c for c, own in zip(conditions, allowed, strict=True) if own]
    doubtful = _doubtful(failures[:, allowed], settings.enough_failures)
    suspects = [c for c, own in zip(always, doubtful, strict=True) if own]
    needed = set(always) - set(_redundant(always, suspects, views, table, background))
    return Preconditions(
        tuple(sorted(needed)),
        tuple(sorted(set(always) - needed)),
        int((~failures.any(axis=1)).sum()),
    )


def _candidates(views: ActionViews, table: ViewTable) -> tuple[list[Condition], Bits]:
    """All literals, positive ones first, and whether views violate them (views, literals).

    Of what is unknown, a success violates nothing, and a failure may have violated everything.
    """
    names = [p.name for p in views.action.parameters]
    different = [LiftedAtom(_EQUAL, (names[i], names[j])) for i, j in views.pairs]
    conditions = [
        *(Condition(atom) for atom in views.atoms),
        *(Condition(atom, holds=False) for atom in (*views.atoms, *different)),
    ]
    done = table.success[:, np.newaxis]
    lacking = np.where(done, table.false_before, ~table.before)
    present = np.where(done, table.before, ~table.false_before)
    return conditions, np.hstack([lacking, present, table.equal])


def _held(table: ViewTable) -> Bits:
    """Whether literals are known to have held (views, literals); in the order of candidates."""
    return np.hstack([table.before, table.false_before, ~table.equal])


def _announced(
    conditions: list[Condition],
    views: ActionViews,
    seen: frozenset[str],
    settings: ActionModelSettings,
) -> Bits:
    """The literals that may be preconditions without a failure as their reason."""
    everything, skeleton = settings.negatives == "all", views.skeleton
    declared = settings.negatives == "declared"

    def is_announced(condition: Condition) -> bool:
        if condition.holds or everything:
            return True
        predicate = condition.atom.predicate
        if predicate == _EQUAL:
            return declared and skeleton.has_equality
        return declared and skeleton.has_negatives and predicate in seen

    return np.array([is_announced(condition) for condition in conditions], dtype=bool)


def _unheard_of(conditions: list[Condition], action: Schema, background: Background) -> Bits:
    """Properties that no object ever had where the action would have worked (literals,).

    Whether the action ends them is unknown. Of what changes, traces show when it does; what
    nobody has seen change is left alone rather than lost: gold in the rock that a laser melts.
    """
    known = background.seen - background.dynamic
    positive = [c for c in conditions if c.holds]
    found = np.zeros(len(conditions), dtype=bool)
    for number, condition in enumerate(conditions):
        atom = condition.atom
        if not condition.holds and len(atom.terms) <= 1 and atom.predicate in known:
            seen = background.witnesses.seen_by(action)
            found[number] = never_came_about(condition, positive, action, seen)
    return found


def _doubtful(failures: Bits, enough: int) -> Bits:
    """The literals that failures speak against: often violated, and never alone."""
    alone = some(failures[failures.sum(axis=1) == 1])
    doubtful: Bits = (failures.sum(axis=0) >= enough) & ~alone
    return doubtful


def _redundant(
    always: list[Condition],
    suspects: list[Condition],
    views: ActionViews,
    table: ViewTable,
    background: Background,
) -> list[Condition]:
    """The suspects that follow from what is likelier to be meant (``_Likelihood``)."""
    if not suspects:
        return []
    seen = background.witnesses.seen_by(views.action)
    likelihood = _Likelihood(views, table, background.dynamic)

    def others(suspect: Condition) -> list[Condition]:
        return [
            c
            for c in always
            if likelihood.may_imply(c, suspect)
            and (c not in suspects or likelihood.is_likelier(c, suspect))
        ]

    return [s for s in suspects if makes_no_difference(s, others(s), views.action, seen)]


class _Likelihood:
    """Which of two literals, of which one follows from the other, is likelier meant.

    What always holds together cannot be told apart, so mostly both are kept. But what is negative
    is given up for what is positive, what the action leaves alone for what it deletes, and what
    names parameters out of order for the same predicate with these parameters in order.

    Args:
        views: the action.
        table: its views.
        dynamic: the predicates of which anything ever changed.
    """

    def __init__(self, views: ActionViews, table: ViewTable, dynamic: frozenset[str]) -> None:
        self._action, self._dynamic = views.action, dynamic
        gone = some((table.before & table.false_after)[table.success])
        self._deleted = {a for a, own in zip(views.atoms, gone, strict=True) if own}

    def is_likelier(self, first: Condition, second: Condition) -> bool:
        """Whether the first is likelier than the second; mostly neither is."""
        one, other = self._rank(first), self._rank(second)
        if one != other or not _same_words(first, second):
            return one < other
        return _disorder(first, self._action) < _disorder(second, self._action)

    def may_imply(self, first: Condition, second: Condition) -> bool:
        """Whether it is more than chance if the second follows from the first.

        What never changes was put into the problems, and no action keeps it so: if it follows from
        what does change, other problems may differ.
        """
        return not second.holds or self._is_dynamic(second) or not self._is_dynamic(first)

    def _is_dynamic(self, condition: Condition) -> bool:
        return condition.atom.predicate in self._dynamic

    def _rank(self, condition: Condition) -> tuple[bool, bool, bool]:
        deleted = condition.atom in self._deleted
        return not condition.holds, not deleted, not self._is_dynamic(condition)


def _same_words(first: Condition, second: Condition) -> bool:
    """Whether two literals differ in the order of terms at most."""
    return first.atom.predicate == second.atom.predicate and sorted(first.atom.terms) == sorted(
        second.atom.terms
    )


def _disorder(condition: Condition, action: Schema) -> int:
    """How many pairs of parameters a literal names in another order than the action does."""
    order = {p.name: number for number, p in enumerate(action.parameters)}
    numbers = [order[term] for term in condition.atom.terms if term in order]
    return sum(a > b for a, b in itertools.combinations(numbers, 2))


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

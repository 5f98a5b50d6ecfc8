"""Pruning: predicates that the data can do without are set dormant (D9)."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import UNKNOWN
from skillwrapper.grounding.abstract_states import different_rows
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.narrowing import narrower
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.symbols import Predicate

_CHANGE = 1.0
"""A change that has a name is worth as much as a transition that is predicted rightly (D26)."""


@dataclass(frozen=True)
class Pruned:
    """A predicate that was taken out of use, and why.

    Attributes:
        predicate: the predicate.
        reason: for people.
        instead: the same for narrower types, which took its place; None if nothing did.
    """

    predicate: Predicate
    reason: str
    instead: Predicate | None = None


def prune(fitter: Fitter, vocabulary: Vocabulary) -> tuple[Pruned, ...]:
    """Merge synonyms and antonyms, set dormant what is superfluous, narrow what is too wide."""
    return (
        *_merge(fitter, vocabulary),
        *_drop_superfluous(fitter, vocabulary),
        *_narrow(fitter, vocabulary),
    )


def find_burdens(
    fitter: Fitter,
    vocabulary: Vocabulary,
    spared: Collection[Predicate] = (),
    *,
    keeps_consistent: bool = True,
) -> tuple[Predicate, ...]:
    """The predicates without which it takes least to account for the data.

    A predicate that says nothing of a skill splits its successes into many small clusters, each
    with an operator that fits its few transitions and no other: consistent, and useless. Several
    of them hide each other, so predicates are left out one after the other, the cheapest to lose
    first, and the best vocabulary on the way is compared with the present one.

    Args:
        fitter: learns operators, and holds the data.
        vocabulary: the predicates.
        spared: predicates that stay in any case.
        keeps_consistent: whether no predicate may go whose absence brings a violation (D9).

    Returns:
        Nothing if every predicate, save the spared ones, is worth what it takes.
    """
    remaining = list(vocabulary.active)
    whole = fitter.fit(remaining)
    allowed = whole if keeps_consistent else None
    lowest, best, lost = whole.cost, tuple(remaining), 0.0
    while left := [p for p in remaining if p not in spared]:
        cheapest, cost = None, math.inf
        for predicate in reversed(left):
            worth = _CHANGE if predicate.name in vocabulary.changes else 0.0
            limit = cost - worth - lost
            less = worth + lost + _cost_without(fitter, remaining, predicate, limit, allowed)
            if less < cost:
                cheapest, cost = predicate, less
        if cheapest is None:
            break
        remaining.remove(cheapest)
        lost += _CHANGE if cheapest.name in vocabulary.changes else 0.0
        if cost < lowest:
            lowest, best = cost, tuple(remaining)
    return tuple(p for p in vocabulary.active if p not in best)


def _cost_without(
    fitter: Fitter,
    predicates: Sequence[Predicate],
    left_out: Predicate,
    limit: float,
    allowed: Fit | None,
) -> float:
    """What it takes without a predicate.

    Infinite if that is not below the limit, or if it is inconsistent where ``allowed`` is not.
    """
    cost = 0.0
    for fit in fitter.fit([p for p in predicates if p != left_out]).each():
        cost += fit.cost
        if cost >= limit or (allowed and not _is_as_good(fit, allowed.skill(fit.skill))):
            return math.inf
    return cost


def _merge(fitter: Fitter, vocabulary: Vocabulary) -> list[Pruned]:
    """Of predicates with equal or opposite labels over all data the first invented stays."""
    kept: list[Predicate] = []
    pruned = []
    for predicate in vocabulary.active:
        for other in kept:
            relation = _relation(fitter, other, predicate)
            if relation:
                vocabulary.set_dormant(predicate)
                pruned.append(Pruned(predicate, f"{relation} of {other.name} on all data"))
                break
        else:
            kept.append(predicate)
    return pruned


def _relation(fitter: Fitter, first: Predicate, second: Predicate) -> str:
    """``"synonym"``, ``"antonym"`` or nothing."""
    if first.types != second.types:
        return ""
    compared = 0
    equal = opposite = True
    for scene in fitter.recorded.scenes:
        a, b = (fitter.labeller.values(scene, [p]) for p in (first, second))
        known = (a != UNKNOWN) & (b != UNKNOWN)
        compared += int(known.sum())
        equal &= bool(np.array_equal(a[known], b[known]))
        opposite &= bool(np.array_equal(a[known], 1 - b[known]))
    if not compared:
        return ""
    return "synonym" if equal else "antonym" if opposite else ""


def _drop_superfluous(fitter: Fitter, vocabulary: Vocabulary) -> list[Pruned]:
    """Set dormant, least used first, each predicate whose removal adds no inconsistency."""
    pruned: list[Pruned] = []
    tried: set[Predicate] = set()
    while True:
        fit = fitter.fit(vocabulary.active)
        left = [p for p in vocabulary.active if p not in tried]
        if not left:
            return pruned
        use = _usage(fit)
        predicate = min(left, key=lambda p: (use[p.name], -vocabulary.active.index(p)))
        tried.add(predicate)
        without = fitter.fit([p for p in vocabulary.active if p != predicate])
        others = [p for p in vocabulary.active if p != predicate]
        if predicate.name in vocabulary.changes and not follows(fitter, others, predicate):
            continue
        if all(_is_as_good(one, fit.skill(one.skill)) for one in without.each()):
            vocabulary.set_dormant(predicate)
            pruned.append(Pruned(predicate, "its removal adds no inconsistency"))


def _narrow(fitter: Fitter, vocabulary: Vocabulary) -> list[Pruned]:
    """Say of narrower types what only these become, if that adds no inconsistency.

    Only where readings may be wrong: else what a word was widened for was so, and to read it
    anew in all pictures would cost as much as to read another one.
    """
    pruned: list[Pruned] = []
    if not fitter.labeller.misread:
        return pruned
    for predicate in vocabulary.active:
        fit = fitter.fit(vocabulary.active)
        candidate = narrower(predicate, fit)
        if candidate is not None:
            narrowed = fitter.fit(vocabulary.with_candidate(candidate))
            as_good = all(_is_as_good(one, fit.skill(one.skill)) for one in narrowed.each())
            if as_good and narrowed.cost <= fit.cost:
                vocabulary.accept(candidate)
                pruned.append(Pruned(predicate, "skills change it of narrower types", candidate))
    return pruned


def follows(fitter: Fitter, others: Sequence[Predicate], predicate: Predicate) -> bool:
    """Whether other predicates tell apart all pictures that a predicate tells apart."""
    for scene in fitter.recorded.scenes:
        own, rest = (fitter.labeller.values(scene, ps) for ps in ([predicate], others))
        if len(different_rows(np.hstack([rest, own]))[0]) > len(different_rows(rest)[0]):
            return False
    return True


def _is_as_good(fit: SkillFit, other: SkillFit) -> bool:
    """Whether what is learned of a skill has no inconsistency that another fit has not.

    Nor leaves all its changes unnoticed, if the other does not (D26).
    """
    notices = fit.unnoticed is None or other.unnoticed is not None
    return fit.witnesses <= other.witnesses and notices


def _usage(fit: Fit) -> Counter[str]:
    """How often each predicate occurs in the operators."""
    use: Counter[str] = Counter()
    for learned in fit.operators:
        operator = learned.operator
        use.update(literal.atom.predicate for literal in operator.preconditions)
        use.update(absence.atom.predicate for absence in operator.absences)
        use.update(atom.predicate for atom in operator.add_effects | operator.delete_effects)
        for effect in operator.conditional_effects:
            use.update(literal.atom.predicate for literal in (*effect.condition, effect.effect))
    return use

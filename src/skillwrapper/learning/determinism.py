"""Operators that predict more than one change are mended before anything is invented (D5).

In this order: split a cluster by the types of its objects; add what stands between and around
context objects, which tells bindings apart; conditional effects where a change ranges over a set.
The first two are used only if they remove every wrong prediction of the operator that they replace,
conditional effects only if they predict more transitions rightly, or as many with fewer operators.
A cluster is also split by types if a combination of types that never worked fails again and again.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from skillwrapper.learning.clusters import Cluster, cluster_successes
from skillwrapper.learning.conditional_effects import (
    cluster_by_core,
    learn_with_conditional_effects,
)
from skillwrapper.learning.fitting import SkillFit
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.operators import LearnedOperator, cluster_operators, operator_of
from skillwrapper.learning.predictions import Predictor
from skillwrapper.transitions.tables import Group, SkillData

_OFTEN = 3
"""So many failures of a combination of types, and no success, are no accident."""


def fit_skill(language: OperatorLanguage, data: SkillData) -> SkillFit:
    """Learn one skill: its operators, mended as far as the vocabulary allows.

    Args:
        language: what they may say.
        data: the transitions of the skill.
    """
    clusters = cluster_successes(data)
    left_out = tuple(c for c in clusters if _is_chance(language, c))
    plain = cluster_operators(language, (c for c in clusters if c not in left_out))
    predictor = Predictor(data)
    chosen: list[LearnedOperator] = []
    for learned in plain:
        mended = _mend(language, predictor, learned) if _mistakes(predictor, [learned]) else ()
        chosen += mended or _restrict(language, predictor, learned) or [learned]
    cores = cluster_by_core(clusters)
    if cores and (cost := _cost(predictor, chosen)) > (0, len(cores)):
        ranging = learn_with_conditional_effects(language, cores)
        if ranging and _cost(predictor, ranging) < cost:
            chosen, left_out = list(ranging), ()
    if chosen != list(plain):
        name = language.skill.name
        chosen = [predictor.rename(o, f"{name}_{n}") for n, o in enumerate(chosen, start=1)]
    return SkillFit(
        language.skill.name,
        tuple(chosen),
        predictor.predict(chosen),
        left_out,
        language.settings.operator_cost,
    )


def _is_chance(language: OperatorLanguage, cluster: Cluster) -> bool:
    """Whether a change was seen once and among so many objects that it is no rule (D23).

    A wrong label links objects that have nothing to do with each other; whatever then held before
    would become an operator of its own for every such error.
    """
    return len(cluster.ids) == 1 and cluster.context > language.settings.context_of_one


def _mend(
    language: OperatorLanguage, predictor: Predictor, learned: LearnedOperator
) -> tuple[LearnedOperator, ...]:
    """What replaces an operator without a wrong prediction; nothing if nothing does."""
    for clusters, between_context in _variants(learned.cluster):
        replacement = tuple(
            operator_of(language, cluster, learned.operator.name, between_context=between_context)
            for cluster in clusters
        )
        if not _mistakes(predictor, replacement):
            return replacement
    return ()


def _restrict(
    language: OperatorLanguage, predictor: Predictor, learned: LearnedOperator
) -> tuple[LearnedOperator, ...]:
    """Operators of fewer combinations of types, if failures tell that the others never work.

    The same if one that works fails often too, but needs more than the others: who gets in by a
    turnstile does not get out by it. Combinations that worked are joined again as long as that
    predicts no more failures to work. Nothing if no combination of types failed often enough where
    the operator applies.
    """
    parts = _split_by_types(learned.cluster)
    refuted = _refuted(predictor, learned)
    if len(parts) < 2 or not refuted:
        return ()
    worked = {tuple(group.types[: language.arity]) for group in learned.cluster.groups}
    are_known = all(len(part.ids) >= _OFTEN for part in parts)
    if refuted <= worked and not are_known:
        return ()
    name = learned.operator.name
    found: list[tuple[Cluster, LearnedOperator]] = []
    for part in parts:
        alone = operator_of(language, part, name)
        for place, (cluster, operator) in enumerate(found):
            joined = Cluster(part.change, (*cluster.groups, *part.groups))
            together = operator_of(language, joined, name)
            if _failures(predictor, [together]) <= _failures(predictor, [operator, alone]):
                found[place] = joined, together
                break
        else:
            found.append((part, alone))
    operators = tuple(operator for _, operator in found)
    before, after = _failures(predictor, [learned]), _failures(predictor, operators)
    return operators if after < before and not _mistakes(predictor, operators) else ()


def _refuted(predictor: Predictor, learned: LearnedOperator) -> set[tuple[tuple[str, ...], ...]]:
    """Types of arguments with which skills often failed where an operator applies."""
    failed: Counter[tuple[tuple[str, ...], ...]] = Counter()
    for prediction in predictor.predict([learned]):
        table = prediction.table
        for row in np.flatnonzero(prediction.disproved).tolist():
            failed[table.argument_types(row)] += 1
    return {types for types, times in failed.items() if times >= _OFTEN}


def _failures(predictor: Predictor, operators: Sequence[LearnedOperator]) -> int:
    """How many failures are predicted to work."""
    return sum(int(p.disproved.sum()) for p in predictor.predict(operators))


def _variants(cluster: Cluster) -> Iterator[tuple[tuple[Cluster, ...], bool]]:
    """(clusters, literals between context objects) to try, the mildest first."""
    parts = _split_by_types(cluster)
    if len(parts) > 1:
        yield parts, False
    if cluster.context:
        yield (cluster,), True


def _split_by_types(cluster: Cluster) -> tuple[Cluster, ...]:
    parts: dict[tuple[tuple[str, ...], ...], list[Group]] = {}
    for group in cluster.groups:
        parts.setdefault(group.types, []).append(group)
    return tuple(Cluster(cluster.change, tuple(parts[types])) for types in sorted(parts))


def _mistakes(predictor: Predictor, operators: Sequence[LearnedOperator]) -> int:
    """How many transitions are mispredicted by an operator that applies."""
    return sum(int(prediction.mistaken.sum()) for prediction in predictor.predict(operators))


def _cost(predictor: Predictor, operators: Sequence[LearnedOperator]) -> tuple[int, int]:
    """Smaller is better: transitions that are predicted wrongly, then the number of operators."""
    wrong = sum(int(p.wrong.sum()) for p in predictor.predict(operators))
    return wrong, len(operators)

"""Operators that predict more than one change are mended before anything is invented (D5).

In this order: split a cluster by the types of its objects; add literals between context objects,
which tells bindings apart; conditional effects where a change ranges over a set. The first two are
used only if they remove every wrong prediction of the operator that they replace, conditional
effects only if they predict more transitions rightly, or as many with fewer operators.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from skillwrapper.grounding import TRUE
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
        chosen += mended or [learned]
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


def _variants(cluster: Cluster) -> Iterator[tuple[tuple[Cluster, ...], bool]]:
    """(clusters, literals between context objects) to try, the mildest first."""
    parts = _split_by_types(cluster)
    if len(parts) > 1:
        yield parts, False
    if cluster.context > 1:
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
    wrong = 0
    for prediction in predictor.predict(operators):
        success = prediction.table.success
        mistaken = np.where(success, ~prediction.accounted, prediction.executable == TRUE)
        wrong += int(((mistaken & ~prediction.undecided) | prediction.mistaken).sum())
    return wrong, len(operators)

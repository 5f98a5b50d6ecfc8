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
from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.conditional_effects import (
    cluster_by_core,
    learn_with_conditional_effects,
)
from skillwrapper.learning.operators import LearnedOperator, cluster_operators, operator_of
from skillwrapper.learning.predictions import Predictor, TablePrediction
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.tables import Group, SkillData
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


def make_deterministic(
    domain: Domain,
    skill: Skill,
    data: SkillData,
    predicates: Sequence[Predicate],
    *,
    absences: bool = True,
) -> tuple[tuple[LearnedOperator, ...], tuple[TablePrediction, ...]]:
    """The operators of a skill, mended as far as the vocabulary allows, and what they predict."""
    plain = cluster_operators(domain, skill, data, predicates, absences=absences)
    predictor = Predictor(data)
    chosen: list[LearnedOperator] = []
    for learned in plain:
        if _mistakes(predictor, [learned]):
            chosen += _mend(domain, skill, predictor, predicates, learned, absences=absences)
        else:
            chosen.append(learned)
    cores = cluster_by_core([o.cluster for o in plain])
    if cores and (cost := _cost(predictor, chosen)) > (0, len(cores)):
        ranging = learn_with_conditional_effects(
            domain, skill, cores, predicates, absences=absences
        )
        if ranging and _cost(predictor, ranging) < cost:
            chosen = list(ranging)
    if chosen == list(plain):
        return plain, predictor.predict(plain)
    named = tuple(
        predictor.rename(o, f"{skill.name}_{number}") for number, o in enumerate(chosen, start=1)
    )
    return named, predictor.predict(named)


def _mend(
    domain: Domain,
    skill: Skill,
    predictor: Predictor,
    predicates: Sequence[Predicate],
    learned: LearnedOperator,
    *,
    absences: bool,
) -> tuple[LearnedOperator, ...]:
    """What replaces an operator without a wrong prediction, or else the operator itself."""
    for clusters, between_context in _variants(learned.cluster):
        replacement = tuple(
            operator_of(
                domain,
                skill,
                cluster,
                predicates,
                learned.operator.name,
                between_context=between_context,
                absences=absences,
            )
            for cluster in clusters
        )
        if not _mistakes(predictor, replacement):
            return replacement
    return (learned,)


def _variants(cluster: Cluster) -> Iterator[tuple[tuple[Cluster, ...], bool]]:
    """(clusters, literals between context objects) to try, the mildest first."""
    parts = _split_by_types(cluster)
    if len(parts) > 1:
        yield parts, False
    first = cluster.groups[0]
    if len(first.lifting.objects) > len(first.instance.arguments) + 1:
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

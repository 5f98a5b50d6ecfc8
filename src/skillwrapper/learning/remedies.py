"""Remedies for operators that predict more than one change (DESIGN.md D5), before invention.

In this order: split a cluster by the types of its objects; add literals between context objects,
which tells bindings apart; conditional effects where a change ranges over a set. The first two are
used only if they remove every wrong prediction of the operator that they replace, conditional
effects only if they predict more transitions rightly, or as many with fewer operators.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from skillwrapper.learning.clusters import Cluster, Group
from skillwrapper.learning.conditional_effects import learn_with_conditional_effects
from skillwrapper.learning.data import SkillData
from skillwrapper.learning.operators import LearnedOperator, learn_operators, operator_of
from skillwrapper.learning.predictions import TablePrediction, predict
from skillwrapper.symbols import TRUE, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


def learn_deterministic_operators(
    domain: Domain,
    skill: Skill,
    data: SkillData,
    predicates: Sequence[Predicate],
    *,
    absences: bool = True,
) -> tuple[tuple[LearnedOperator, ...], tuple[TablePrediction, ...]]:
    """The operators of a skill, mended as far as the vocabulary allows, and what they predict."""
    plain = learn_operators(domain, skill, data, predicates, absences=absences)
    predictions = predict(data, plain)
    mistaken = _mistaken_operators(predictions)
    chosen: list[LearnedOperator] = []
    for learned in plain:
        if learned.operator.name in mistaken:
            chosen += _mend(domain, skill, data, predicates, learned, absences=absences)
        else:
            chosen.append(learned)
    clusters = [o.cluster for o in plain]
    ranging = learn_with_conditional_effects(domain, skill, clusters, predicates, absences=absences)
    if ranging and _cost(data, ranging) < _cost(data, chosen):
        chosen = list(ranging)
    if chosen == list(plain):
        return plain, predictions
    named = tuple(
        LearnedOperator(o.operator.renamed(f"{skill.name}_{number}"), o.cluster)
        for number, o in enumerate(chosen, start=1)
    )
    return named, predict(data, named)


def _mistaken_operators(predictions: Sequence[TablePrediction]) -> frozenset[str]:
    """Names of the operators that mispredict a change somewhere."""
    return frozenset(
        a.learned.operator.name
        for prediction in predictions
        for a in prediction.applications
        if len(prediction.mispredicted(a))
    )


def _mend(
    domain: Domain,
    skill: Skill,
    data: SkillData,
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
        if not _mistakes(data, replacement):
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


def _mistakes(data: SkillData, operators: Sequence[LearnedOperator]) -> int:
    """How many transitions are mispredicted by an operator that applies."""
    return sum(
        len({int(row) for a in prediction.applications for row in prediction.mispredicted(a)})
        for prediction in predict(data, operators)
    )


def _cost(data: SkillData, operators: Sequence[LearnedOperator]) -> tuple[int, int]:
    """Smaller is better: transitions that are predicted wrongly, then the number of operators."""
    wrong = 0
    for prediction in predict(data, operators):
        success = prediction.table.success
        mistaken = np.where(success, ~prediction.accounted, prediction.executable == TRUE)
        mistaken &= ~prediction.undecided
        for application in prediction.applications:
            mistaken[prediction.mispredicted(application)] = True
        wrong += int(mistaken.sum())
    return wrong, len(operators)

"""Operator learning: from the transitions of a skill to its operators (paper, Section 3.3)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from skillwrapper.grounding.atom_index import ANY, LiftedAtom
from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.preconditions import (
    Evidence,
    ExistentialContext,
    gather_evidence,
)
from skillwrapper.symbols import Absence, Atom, Literal, Operator, Variable
from skillwrapper.transitions.tables import Group
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


@dataclass(frozen=True, eq=False)
class LearnedOperator:
    """An operator with the cluster it was learned from.

    Attributes:
        operator: the operator.
        cluster: its transitions.
    """

    operator: Operator
    cluster: Cluster


def cluster_operators(
    language: OperatorLanguage, clusters: Iterable[Cluster]
) -> tuple[LearnedOperator, ...]:
    """One operator for each cluster of successes of a skill, numbered in their order."""
    return tuple(
        operator_of(language, cluster, f"{language.skill.name}_{number}")
        for number, cluster in enumerate(clusters, start=1)
    )


def operator_of(
    language: OperatorLanguage, cluster: Cluster, name: str, *, between_context: bool = False
) -> LearnedOperator:
    """The operator of one cluster: the change it shares, under all that held before.

    Args:
        language: what it may say.
        cluster: the successes.
        name: its name.
        between_context: whether it may speak of context objects alone (D5).
    """
    domain, skill, arity = language.domain, language.skill, language.arity
    evidence = gather_evidence(cluster.groups, language, between_context=between_context)
    types = [frozenset.intersection(*map(frozenset, column)) for column in _slots(cluster.groups)]
    parameters = _name_parameters(domain, skill, types, evidence.existentials)
    names = [v.name for v in parameters]
    operator = Operator(
        name=name,
        skill=skill.name,
        parameters=parameters,
        arity=arity,
        preconditions=_preconditions(evidence, names, len(types)),
        absences=frozenset(_absence(pattern, names) for pattern in evidence.absences),
        add_effects=_effects(cluster, names, positive=True),
        delete_effects=_effects(cluster, names, positive=False),
    )
    return LearnedOperator(operator, cluster)


def _slots(groups: Sequence[Group]) -> list[tuple[tuple[str, ...], ...]]:
    """For every position the types of the objects seen there."""
    return list(zip(*(group.types for group in groups), strict=True))


def _name_parameters(
    domain: Domain,
    skill: Skill,
    types: Sequence[frozenset[str]],
    existentials: Sequence[ExistentialContext],
) -> tuple[Variable, ...]:
    """The skill's own names for its parameters; context objects are named by their type."""
    wanted = [p.name for p in skill.parameters]
    specific = [domain.types.most_specific(t) for t in types]
    specific += [domain.types.most_specific(e.types) for e in existentials]
    wanted += [f"other_{t[0] if t else 'object'}" for t in specific[len(wanted) :]]
    names: list[str] = []
    for name in wanted:
        number = 2
        unique = name
        while unique in names:
            unique, number = f"{name}_{number}", number + 1
        names.append(unique)
    return tuple(Variable(f"?{n}", t) for n, t in zip(names, specific, strict=True))


def _preconditions(evidence: Evidence, names: Sequence[str], size: int) -> frozenset[Literal]:
    plain = {Literal(_atom(pattern, names), truth) for pattern, truth in evidence.literals}
    context = {
        Literal(_atom(pattern, names, other=names[size + number]))
        for number, existential in enumerate(evidence.existentials)
        for pattern in existential.patterns
    }
    return frozenset(plain | context)


def _absence(pattern: LiftedAtom, names: Sequence[str]) -> Absence:
    return Absence(_atom(pattern, names, other="?any"), ("?any",))


def _atom(pattern: LiftedAtom, names: Sequence[str], other: str = "") -> Atom:
    predicate, terms = pattern
    return Atom(predicate, tuple(other if t == ANY else names[t] for t in terms))


def _effects(cluster: Cluster, names: Sequence[str], *, positive: bool) -> frozenset[Atom]:
    return frozenset(
        Atom(predicate, tuple(names[t] for t in terms))
        for added, predicate, terms in cluster.change
        if added is positive
    )

"""Conditional effects: changes that range over a set of objects (DESIGN.md D5).

A tray that is moved takes along whatever lies on it. As plain effects that is another operator
for every number of things; as conditional effects it is one: for every other object that lies on
the tray, its place changes.

The core of a change is what is left of it without the objects that a change ranges over. One
operator is learned from all successes with the same core; what happens to any other object must
then follow from the relations in which it stood to the core's objects.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skillwrapper.learning.clusters import Cluster, Group, changed_literals
from skillwrapper.learning.lifting import LiftedChange, lift_change
from skillwrapper.learning.operators import LearnedOperator, operator_of
from skillwrapper.learning.preconditions import OTHER, Pattern
from skillwrapper.symbols import (
    TRUE,
    Atom,
    ConditionalEffect,
    Literal,
    Operator,
    Predicate,
    Variable,
)
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill

EACH = "?each"

SignedPattern = tuple[bool, Pattern]
"""Became true or false; the pattern has one ``OTHER``."""


@dataclass(frozen=True)
class _Case:
    """Another object in a successful transition, and whether it changed.

    Attributes:
        held: the patterns that were true of it before.
        types: its types.
        changed: whether it made the change in question.
    """

    held: frozenset[Pattern]
    types: frozenset[str]
    changed: bool


@dataclass(frozen=True)
class _Rule:
    change: SignedPattern
    condition: tuple[tuple[Pattern, bool], ...]
    types: frozenset[str]

    def covers(self, case: _Case) -> bool:
        """Whether it says that an object changes."""
        met = all((pattern in case.held) is truth for pattern, truth in self.condition)
        return met and self.types <= case.types


def learn_with_conditional_effects(
    domain: Domain,
    skill: Skill,
    clusters: Sequence[Cluster],
    predicates: Sequence[Predicate],
    *,
    absences: bool = True,
) -> tuple[LearnedOperator, ...]:
    """Operators with conditional effects; none if no change ranges over a set by a rule.

    Args:
        domain: for the type hierarchy.
        skill: the skill.
        clusters: its successes.
        predicates: the vocabulary without tautologies.
        absences: whether preconditions may be universal absences.
    """
    groups = [group for cluster in clusters for group in cluster.groups]
    ranging = _ranging_changes(groups)
    if not ranging:
        return ()
    learned = []
    for number, cluster in enumerate(_cluster_by_core(groups, ranging), start=1):
        rules = _find_rules(cluster, predicates)
        if rules is None:
            return ()
        name = f"{skill.name}_{number}"
        plain = operator_of(domain, skill, cluster, predicates, name, absences=absences)
        effects = frozenset(_effect(domain, plain.operator, rule) for rule in rules)
        operator = replace(plain.operator, conditional_effects=effects)
        learned.append(replace(plain, operator=operator))
    return tuple(learned)


def _changed(group: Group) -> list[Literal]:
    """The literals that became true in the transitions of a group."""
    return changed_literals(group.table.space, group.table.change()[group.rows[0]])


def _signed_pattern(literal: Literal, objects: Sequence[str]) -> tuple[SignedPattern, str] | None:
    """A changed literal as a pattern over objects and the one other object in it, if it is one."""
    others = [t for t in literal.atom.terms if t not in objects]
    if len(others) != 1:
        return None
    terms = tuple(OTHER if t not in objects else objects.index(t) for t in literal.atom.terms)
    return (literal.positive, (literal.atom.predicate, terms)), others[0]


def _ranging_changes(groups: Sequence[Group]) -> frozenset[SignedPattern]:
    """Changes around the arguments that some transition made with several other objects."""
    found: set[SignedPattern] = set()
    for group in groups:
        patterns = (_signed_pattern(x, group.instance.arguments) for x in _changed(group))
        counts = Counter(p[0] for p in patterns if p is not None)
        found.update(change for change, number in counts.items() if number > 1)
    return frozenset(found)


def _cluster_by_core(
    groups: Sequence[Group], ranging: frozenset[SignedPattern]
) -> tuple[Cluster, ...]:
    """The groups by the part of their change without objects that made a ranging change."""
    found: dict[LiftedChange, list[Group]] = {}
    for group in groups:
        arguments = group.instance.arguments
        changed = _changed(group)
        patterns = (_signed_pattern(literal, arguments) for literal in changed)
        moved = {p[1] for p in patterns if p is not None and p[0] in ranging}
        core = [literal for literal in changed if not moved.intersection(literal.atom.terms)]
        types = {o.name: o.types for o in group.table.space.objects}
        lifting = lift_change(core, arguments, types)
        found.setdefault(lifting.change, []).append(replace(group, lifting=lifting))
    return tuple(Cluster(change, tuple(found[change])) for change in sorted(found))


def _find_rules(cluster: Cluster, predicates: Sequence[Predicate]) -> tuple[_Rule, ...] | None:
    """Rules for all that happened to objects outside the core; None if there are none."""
    changes: set[SignedPattern] = set()
    for group in cluster.groups:
        for literal in _changed(group):
            if not set(literal.atom.terms) <= set(group.lifting.objects):
                pattern = _signed_pattern(literal, group.lifting.objects)
                if pattern is None:
                    return None
                changes.add(pattern[0])
    size = len(cluster.groups[0].lifting.objects)
    patterns = tuple(_patterns(predicates, size))
    slots = {p.name: p.types for p in predicates}
    rules = [_find_rule(cluster, patterns, slots, change) for change in sorted(changes)]
    found = tuple(rule for rule in rules if rule is not None)
    return found if len(found) == len(rules) else None


def _patterns(predicates: Sequence[Predicate], size: int) -> Iterator[Pattern]:
    for predicate in predicates:
        for place in range(predicate.arity):
            for terms in itertools.permutations(range(size), predicate.arity - 1):
                yield predicate.name, (*terms[:place], OTHER, *terms[place:])


def _find_rule(
    cluster: Cluster,
    patterns: Sequence[Pattern],
    slots: Mapping[str, tuple[str, ...]],
    change: SignedPattern,
) -> _Rule | None:
    """What all objects that changed had in common, as little of it as tells them from the others.

    An object that is said to change and does not is as wrong as the reverse, so nothing speaks
    for the most specific condition. None if no condition tells them apart.
    """
    cases = [case for group in cluster.groups for case in _cases(group, patterns, change)]
    changed = [case for case in cases if case.changed]
    if not changed:
        return None
    always = frozenset.intersection(*(case.held for case in changed))
    never = frozenset(patterns) - frozenset.union(*(case.held for case in changed))
    predicate, terms = change[1]
    rule = _Rule(
        change,
        tuple(sorted([*((p, True) for p in always), *((p, False) for p in never)])),
        frozenset.intersection(*(case.types for case in changed)),
    )
    others = [case for case in cases if not case.changed]
    if any(rule.covers(case) for case in others):
        return None
    wider = frozenset({slots[predicate][terms.index(OTHER)]})
    return _simplest([replace(rule, types=wider), rule], others)


def _simplest(rules: Sequence[_Rule], others: Sequence[_Case]) -> _Rule:
    """The first rule that covers no other case, without the literals that it can do without.

    Properties go before relations to the core's objects, and what is false before what is true.
    """
    rule = next(rule for rule in rules if not any(rule.covers(case) for case in others))
    for literal in sorted(rule.condition, key=lambda c: (len(c[0][1]), c[1], c)):
        left = tuple(c for c in rule.condition if c != literal)
        simpler = replace(rule, condition=left)
        if left and not any(simpler.covers(case) for case in others):
            rule = simpler
    return rule


def _cases(group: Group, patterns: Sequence[Pattern], change: SignedPattern) -> Iterator[_Case]:
    """Every object that is no argument, in every different state before the group's transitions.

    Of objects that changed, all labels are known: else the group would have founded no cluster.
    """
    became, wanted = change
    signed = group.table.change()[group.rows[0]]
    for other in group.table.space.objects:
        columns = _columns(group, patterns, other.name)
        if other.name in group.instance.arguments or wanted not in columns:
            continue
        did = bool(signed[columns[wanted]] == (1 if became else -1))
        for state in np.unique(group.before[:, list(columns.values())], axis=0):
            held = (p for p, label in zip(columns, state, strict=True) if label == TRUE)
            yield _Case(frozenset(held), frozenset(other.types), did)


def _columns(group: Group, patterns: Sequence[Pattern], other: str) -> dict[Pattern, int]:
    """The columns of the patterns that have a grounding with an object."""
    objects, space = group.lifting.objects, group.table.space
    found = {}
    for name, terms in patterns:
        atom = Atom(name, tuple(other if t == OTHER else objects[t] for t in terms))
        if atom in space.column:
            found[name, terms] = space.column[atom]
    return found


def _effect(domain: Domain, operator: Operator, rule: _Rule) -> ConditionalEffect:
    names = [v.name for v in operator.parameters]

    def atom(pattern: Pattern) -> Atom:
        return Atom(pattern[0], tuple(EACH if t == OTHER else names[t] for t in pattern[1]))

    became, pattern = rule.change
    return ConditionalEffect(
        Variable(EACH, domain.types.most_specific(rule.types)),
        tuple(sorted(Literal(atom(p), truth) for p, truth in rule.condition)),
        Literal(atom(pattern), became),
    )

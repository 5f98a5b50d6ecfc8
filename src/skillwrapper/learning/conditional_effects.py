"""Conditional effects: changes that range over a set of objects (D5).

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
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE
from skillwrapper.grounding.atom_index import ANY, Columns, LiftedAtom, taken_objects
from skillwrapper.learning.clusters import Bundle, Cluster, bundle_groups
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.operators import LearnedOperator, operator_of
from skillwrapper.symbols import Atom, ConditionalEffect, Literal, Operator, Predicate, Variable
from skillwrapper.transitions.lifting import LiftedChange
from skillwrapper.transitions.tables import Group
from skillwrapper.world.domain import Domain

EACH = "?each"

SignedPattern = tuple[bool, LiftedAtom]
"""Became true or false; the pattern has one ``ANY``."""


@dataclass(frozen=True)
class _Rule:
    change: SignedPattern
    condition: tuple[tuple[LiftedAtom, bool], ...]
    types: frozenset[str]


def cluster_by_core(clusters: Sequence[Cluster]) -> tuple[Cluster, ...]:
    """Clusters by the part of the change without objects over which it ranges.

    Args:
        clusters: the successes of a skill.

    Returns:
        Nothing if no change ranges over a set.
    """
    groups = [group for cluster in clusters for group in cluster.groups]
    ranging = _ranging_changes(groups)
    return _cluster_by_core(groups, ranging) if ranging else ()


def learn_with_conditional_effects(
    language: OperatorLanguage, cores: Sequence[Cluster]
) -> tuple[LearnedOperator, ...]:
    """Operators with conditional effects; none if some change follows no rule.

    Args:
        language: what they may say.
        cores: the successes of the skill, clustered by core.
    """
    learned = []
    for number, cluster in enumerate(cores, start=1):
        rules = _find_rules(cluster, language.predicates)
        if rules is None:
            return ()
        plain = operator_of(language, cluster, f"{language.skill.name}_{number}")
        effects = frozenset(_effect(language.domain, plain.operator, rule) for rule in rules)
        operator = replace(plain.operator, conditional_effects=effects)
        learned.append(replace(plain, operator=operator))
    return tuple(learned)


def _signed_pattern(literal: Literal, objects: Sequence[str]) -> tuple[SignedPattern, str] | None:
    """A changed literal as a pattern over objects and the one other object in it, if it is one."""
    others = [t for t in literal.atom.terms if t not in objects]
    if len(others) != 1:
        return None
    terms = tuple(ANY if t not in objects else objects.index(t) for t in literal.atom.terms)
    return (literal.positive, (literal.atom.predicate, terms)), others[0]


def _ranging_changes(groups: Sequence[Group]) -> frozenset[SignedPattern]:
    """Changes that some transition made with several other objects, or with an unconnected one.

    What is changed and connected to nothing may stand in a relation that does not change: what is
    in a machine is washed, and stays in it. A relation that comes about between the arguments and
    with one other object besides, but not always, ranges as well: who is put on top of somebody is
    above all that are below.
    """
    found: set[SignedPattern] = set()
    spreading: Counter[SignedPattern] = Counter()
    for group in groups:
        arguments = group.instance.arguments
        patterns = [(_signed_pattern(x, arguments), x) for x in group.changed]
        counts = Counter(p[0] for p, _ in patterns if p is not None)
        found.update(change for change, number in counts.items() if number > 1)
        strange = group.lifting.unexplained
        found.update(p[0] for p, x in patterns if p is not None and x.atom in strange)
        between = {_inner(x, arguments) for p, x in patterns if p is None}
        spreading.update(c for c in counts if between & set(_fillings(c, len(arguments))))
    found.update(change for change, times in spreading.items() if times < len(groups))
    return frozenset(found)


def _inner(literal: Literal, objects: Sequence[str]) -> SignedPattern:
    """A changed literal as a pattern over objects; what is none of them is ``ANY``."""
    terms = tuple(objects.index(t) if t in objects else ANY for t in literal.atom.terms)
    return literal.positive, (literal.atom.predicate, terms)


def _fillings(change: SignedPattern, arity: int) -> Iterator[SignedPattern]:
    """The same change with an argument in the place of the other object."""
    became, (predicate, terms) = change
    if len(terms) > 1:
        for number in set(range(arity)) - set(terms):
            filled = tuple(number if t == ANY else t for t in terms)
            yield became, (predicate, filled)


def _cluster_by_core(
    groups: Sequence[Group], ranging: frozenset[SignedPattern]
) -> tuple[Cluster, ...]:
    """The groups by the part of their change without objects that made a ranging change."""
    found: dict[LiftedChange, list[Group]] = {}
    for group in groups:
        arguments = group.instance.arguments
        changed = group.changed
        patterns = (_signed_pattern(literal, arguments) for literal in changed)
        moved = {p[1] for p in patterns if p is not None and p[0] in ranging}
        core = [literal for literal in changed if not moved.intersection(literal.atom.terms)]
        lifting = group.table.lifter.lift(core, arguments, group.table.types)
        found.setdefault(lifting.change, []).append(replace(group, lifting=lifting))
    return tuple(Cluster(change, tuple(found[change])) for change in sorted(found))


def _find_rules(cluster: Cluster, predicates: Sequence[Predicate]) -> tuple[_Rule, ...] | None:
    """Rules for all that happened to objects outside the core; None if there are none."""
    changes: set[SignedPattern] = set()
    for group in cluster.groups:
        for literal in group.changed:
            if not set(literal.atom.terms) <= set(group.lifting.objects):
                pattern = _signed_pattern(literal, group.lifting.objects)
                if pattern is None:
                    return None
                changes.add(pattern[0])
    size = len(cluster.groups[0].lifting.objects)
    patterns = tuple(_patterns(predicates, size))
    slots = {p.name: p.types for p in predicates}
    scenes = [_Others.of(bundle, patterns, size) for bundle in bundle_groups(cluster.groups)]
    rules = [_find_rule(scenes, patterns, slots, change) for change in sorted(changes)]
    found = tuple(rule for rule in rules if rule is not None)
    return found if len(found) == len(rules) else None


def _patterns(predicates: Sequence[Predicate], size: int) -> Iterator[LiftedAtom]:
    for predicate in predicates:
        for place in range(predicate.arity):
            for terms in itertools.permutations(range(size), predicate.arity - 1):
                yield predicate.name, (*terms[:place], ANY, *terms[place:])


@dataclass(frozen=True, eq=False)
class _Others:
    """All objects of a scene that are no arguments, before the transitions of a cluster.

    Attributes:
        bundle: the transitions.
        columns: the columns (groups, patterns, objects) of the patterns; -1 for no grounding.
        held: whether a pattern was true of an object (rows, objects, patterns).
    """

    bundle: Bundle
    columns: Columns
    held: NDArray[np.bool_]

    @classmethod
    def of(cls, bundle: Bundle, patterns: Sequence[LiftedAtom], size: int) -> _Others:
        index = bundle.table.space.index
        columns = index.open_columns(index.patterns(patterns, size), bundle.bindings)
        arguments = bundle.table.arguments[bundle.table.which[bundle.rows[bundle.first]]]
        others = ~taken_objects(arguments, len(bundle.table.space.objects))
        columns = np.where(others[:, np.newaxis, :], columns, -1)
        return cls(bundle, columns, (bundle.labels(columns) == TRUE).transpose(0, 2, 1))

    def cases(self, place: int, sign: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Objects that could have made a change, and those that did: (rows, objects) each.

        Of what was so before nobody could see it come about. Of objects that changed, all labels
        are known: else the group would have founded no cluster.
        """
        columns = self.columns[:, place]
        first = self.bundle.rows[self.bundle.first]
        could = columns >= 0
        did = np.zeros_like(could)
        groups, _ = np.nonzero(could)  # a scene may have no column at all
        did[could] = self.bundle.table.change[first[groups], columns[could]] == sign
        was_so = self.held[:, :, place] == (sign > 0)
        return could[self.bundle.group] & ~was_so, did[self.bundle.group]

    def types(self, marked: NDArray[np.bool_]) -> list[frozenset[str]]:
        """The types of those objects of the scene that are marked (rows, objects) in any row."""
        things = self.bundle.table.space.objects
        return [frozenset(things[i].types) for i in np.unique(np.nonzero(marked)[1])]


def _find_rule(
    scenes: Sequence[_Others],
    patterns: Sequence[LiftedAtom],
    slots: Mapping[str, tuple[str, ...]],
    change: SignedPattern,
) -> _Rule | None:
    """What all objects that changed had in common, as little of it as tells them from the others.

    An object that is said to change and does not is as wrong as the reverse, so nothing speaks
    for the most specific condition. None if no condition tells them apart.
    """
    became, wanted = change
    cases = [scene.cases(patterns.index(wanted), 1 if became else -1) for scene in scenes]
    pairs = list(zip(scenes, cases, strict=True))
    changed = np.concatenate([scene.held[did] for scene, (_, did) in pairs])
    if not len(changed):
        return None
    condition = {int(i): True for i in np.flatnonzero(changed.all(axis=0))}
    condition |= {int(i): False for i in np.flatnonzero(~changed.any(axis=0))}
    predicate, terms = wanted
    widest = frozenset({slots[predicate][terms.index(ANY)]})
    types_seen = (t for scene, (_, did) in pairs for t in scene.types(did))
    for types in (widest, frozenset.intersection(*types_seen)):
        others = [
            scene.held[could & ~did & scene.bundle.table.space.index.of_types(types)]
            for scene, (could, did) in pairs
        ]
        unchanged = np.concatenate(others)
        if not _holds_somewhere(condition, unchanged):
            simplest = _simplest(condition, patterns, unchanged)
            literals = sorted((patterns[i], truth) for i, truth in simplest.items())
            if len(terms) == 1 and not any(len(p[1]) > 1 and truth for p, truth in literals):
                return None  # nothing ties it to the core's objects
            return _Rule(change, tuple(literals), types)
    return None


def _simplest(
    condition: dict[int, bool], patterns: Sequence[LiftedAtom], unchanged: NDArray[np.bool_]
) -> dict[int, bool]:
    """A condition that holds of nothing unchanged, without what it can do without.

    Properties go before relations to the core's objects, and what is false before what is true.
    Some relation that holds is left if there is one.
    """
    left = dict(condition)
    ties = {i for i, truth in condition.items() if truth and len(patterns[i][1]) > 1}
    for number in sorted(condition, key=lambda i: (len(patterns[i][1]), condition[i], patterns[i])):
        fewer = {i: truth for i, truth in left.items() if i != number}
        if fewer and not _holds_somewhere(fewer, unchanged) and (not ties or ties & fewer.keys()):
            left = fewer
    return left


def _holds_somewhere(condition: Mapping[int, bool], cases: NDArray[np.bool_]) -> bool:
    """Whether some case (n, patterns) meets a condition."""
    found: NDArray[np.bool_] = (cases[:, list(condition)] == list(condition.values())).all(axis=1)
    return bool(found.any())


def _effect(domain: Domain, operator: Operator, rule: _Rule) -> ConditionalEffect:
    names = [v.name for v in operator.parameters]

    def atom(pattern: LiftedAtom) -> Atom:
        return Atom(pattern[0], tuple(EACH if t == ANY else names[t] for t in pattern[1]))

    became, pattern = rule.change
    return ConditionalEffect(
        Variable(EACH, domain.types.most_specific(rule.types)),
        tuple(sorted(Literal(atom(p), truth) for p, truth in rule.condition)),
        Literal(atom(pattern), became),
    )

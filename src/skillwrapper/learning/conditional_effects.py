"""Conditional effects: changes that range over a set of objects (DESIGN.md D5).

A tray that is moved takes along whatever lies on it. As plain effects that is another operator
for every number of things; as a conditional effect it is one: for every other object that lies on
the tray, its place changes.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skillwrapper.learning.data import SkillData, SkillTable
from skillwrapper.learning.operators import LearnedOperator, learn_operators
from skillwrapper.learning.preconditions import OTHER, Pattern
from skillwrapper.symbols import FALSE, TRUE, Atom, ConditionalEffect, Literal, Predicate, Variable
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


def learn_with_conditional_effects(
    domain: Domain, skill: Skill, data: SkillData, predicates: Sequence[Predicate]
) -> tuple[LearnedOperator, ...]:
    """Operators with conditional effects; none if no change ranges over a set."""
    patterns = tuple(_patterns(predicates, len(skill.parameters)))
    rules = [
        rule
        for change in _ranging_changes(data, patterns)
        if (rule := _find_rule(data, patterns, change)) is not None
    ]
    if not rules:
        return ()
    masked = tuple(_without(table, [rule.change for rule in rules]) for table in data)
    effects = frozenset(_effect(domain, skill, rule) for rule in rules)
    return tuple(
        replace(o, operator=replace(o.operator, conditional_effects=effects))
        for o in learn_operators(domain, skill, masked, predicates)
    )


def _patterns(predicates: Sequence[Predicate], arity: int) -> Iterator[Pattern]:
    for predicate in predicates:
        for place in range(predicate.arity):
            for terms in itertools.permutations(range(arity), predicate.arity - 1):
                yield predicate.name, (*terms[:place], OTHER, *terms[place:])


def _ranging_changes(data: SkillData, patterns: Sequence[Pattern]) -> list[SignedPattern]:
    """Changes that some transition made with several other objects."""
    found: set[SignedPattern] = set()
    for table in data:
        change = table.change()
        for number in range(len(table.instances)):
            rows = np.flatnonzero(table.success & (table.which == number))
            if not len(rows):
                continue
            columns: dict[Pattern, list[int]] = {}
            for pattern, _, column in _groundings(table, int(rows[0]), patterns):
                columns.setdefault(pattern, []).append(column)
            for pattern, own in columns.items():
                made = change[rows][:, own]
                for became, sign in ((True, 1), (False, -1)):
                    if ((made == sign).sum(axis=1) > 1).any():
                        found.add((became, pattern))
    return sorted(found)


def _find_rule(data: SkillData, patterns: Sequence[Pattern], change: SignedPattern) -> _Rule | None:
    """What all objects that changed had in common, if no other object had all of it."""
    cases = [case for table in data for case in _cases(table, patterns, change)]
    changed = [case for case in cases if case.changed]
    always = frozenset.intersection(*(case.held for case in changed))
    never = frozenset(patterns) - frozenset.union(*(case.held for case in changed))
    types = frozenset.intersection(*(case.types for case in changed))
    for case in cases:
        fits = types <= case.types and always <= case.held and not never & case.held
        if fits and not case.changed:
            return None
    needed = {(p, True) for p in always} | {
        (p, False)
        for p in never
        if any(p in case.held and types <= case.types for case in cases if not case.changed)
    }
    return _Rule(change, tuple(sorted(needed)), types)


def _cases(
    table: SkillTable, patterns: Sequence[Pattern], change: SignedPattern
) -> Iterator[_Case]:
    became, wanted = change
    changes = table.change()
    for row in np.flatnonzero(table.success):
        held: dict[int, set[Pattern]] = {}
        changed: dict[int, bool] = {}
        for pattern, other, column in _groundings(table, int(row), patterns):
            if table.before[row, column] == TRUE:
                held.setdefault(other, set()).add(pattern)
            if pattern == wanted:
                changed[other] = changes[row, column] == (1 if became else -1)
        for other, did in changed.items():
            types = frozenset(table.space.objects[other].types)
            yield _Case(frozenset(held.get(other, ())), types, did)


def _groundings(
    table: SkillTable, row: int, patterns: Sequence[Pattern]
) -> Iterator[tuple[Pattern, int, int]]:
    """(pattern, index of the other object, column) around a transition."""
    arguments = table.instances[table.which[row]].arguments
    for other, thing in enumerate(table.space.objects):
        if thing.name in arguments:
            continue
        for name, terms in patterns:
            atom = Atom(name, tuple(thing.name if t == OTHER else arguments[t] for t in terms))
            column = table.space.column.get(atom)
            if column is not None:
                yield (name, terms), other, column


def _without(table: SkillTable, changes: Sequence[SignedPattern]) -> SkillTable:
    """The table as if these changes had not happened."""
    after = table.after.copy()
    happened = table.change()
    patterns = [pattern for _, pattern in changes]
    for row in np.flatnonzero(table.success):
        for pattern, _, column in _groundings(table, int(row), patterns):
            became = happened[row, column] > 0
            if happened[row, column] and (bool(became), pattern) in changes:
                after[row, column] = FALSE if became else TRUE
    return replace(table, after=after)


def _effect(domain: Domain, skill: Skill, rule: _Rule) -> ConditionalEffect:
    names = [f"?{p.name}" for p in skill.parameters]

    def atom(pattern: Pattern) -> Atom:
        return Atom(pattern[0], tuple(EACH if t == OTHER else names[t] for t in pattern[1]))

    became, pattern = rule.change
    return ConditionalEffect(
        Variable(EACH, domain.types.most_specific(rule.types)),
        tuple(sorted(Literal(atom(p), truth) for p, truth in rule.condition)),
        Literal(atom(pattern), became),
    )

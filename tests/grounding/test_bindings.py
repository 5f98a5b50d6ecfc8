"""Binding all at once by joining finds what binding one after the other to all objects finds."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from model_strategies import DOMAIN, models
from scalar_grounding import ground_operator

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, GroundModel, Labels, joins
from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.bindings import Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings
from skillwrapper.symbols import (
    Absence,
    AbstractModel,
    Atom,
    ConditionalEffect,
    Literal,
    Operator,
    Predicate,
    Variable,
)
from skillwrapper.world import Object, SkillInstance

QUICK = settings(
    max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
Verdict = tuple[int, tuple[str, ...], int, bytes]
"""Row, objects, applicability and effect of a binding."""


def kleene(space: AtomSpace, chance: np.random.Generator, rows: int = 3) -> Labels:
    """States with few true atoms, and one atom in ten unknown."""
    shape = (rows, len(space.atoms))
    return chance.choice([TRUE, FALSE, UNKNOWN], shape, p=[0.3, 0.6, 0.1]).astype(np.int8)


def one_after_the_other(model: AbstractModel, space: AtomSpace, states: Labels) -> Counter[Verdict]:
    found: Counter[Verdict] = Counter()
    for ground in (g for o in model.operators for g in ground_operator(o, space)):
        applicability = ground.applicability(states)
        for row in np.flatnonzero(applicability != FALSE).tolist():
            effect = ground.effects(states[[row]])[0].tobytes()
            found[row, ground.arguments, int(applicability[row]), effect] += 1
    return found


def verdicts(bindings: Bindings) -> Iterator[Verdict]:
    names = [o.name for o in bindings.operator.space.objects]
    for row, objects, applicability, effect in zip(
        bindings.rows.tolist(),
        bindings.objects.tolist(),
        bindings.applicability.tolist(),
        bindings.effects(),
        strict=True,
    ):
        yield row, tuple(names[n] for n in objects), applicability, effect.tobytes()


@QUICK
@given(models(), st.integers(0, 10**6))
def test_every_binding_that_may_apply_and_its_effect(model: AbstractModel, seed: int) -> None:
    ground = GroundModel.of(model, DOMAIN.objects)
    states = kleene(ground.space, np.random.default_rng(seed))
    found = Counter(v for bindings in ground.bind_all(states) for v in verdicts(bindings))
    assert found == one_after_the_other(model, ground.space, states)


@QUICK
@given(models(), st.integers(0, 10**6))
def test_of_given_skill_instances(model: AbstractModel, seed: int) -> None:
    ground = GroundModel.of(model, DOMAIN.objects)
    states = kleene(ground.space, np.random.default_rng(seed))
    found: Counter[Verdict] = Counter()
    for skill in DOMAIN.skills:
        instances = [i for i in DOMAIN.skill_instances if i.skill == skill.name]
        for bindings in ground.bind(states, instances):
            found.update(verdicts(bindings))
            assert [instances[n] for n in bindings.which] == bindings.instances
    assert found == one_after_the_other(model, ground.space, states)


@QUICK
@given(models(), st.integers(0, 10**6), st.integers(0, 2))
def test_bindings_with_few_unmet_conditions(model: AbstractModel, seed: int, most: int) -> None:
    """All bindings are found by allowing all conditions to be unmet, fewer by allowing fewer."""
    space = AtomSpace(model.predicates, DOMAIN.objects)
    states = AbstractStates(kleene(space, np.random.default_rng(seed)))
    for operator in model.operators:
        indexed = IndexedOperator(operator, space, frozenset(operator.context))
        attempts = Attempts.unbound(states)
        everything = find_bindings(indexed, attempts, most_unmet=len(indexed.conditions))
        wanted, found = set(), set()
        for bindings in everything:
            met = bindings.met()
            assert ((met == FALSE).sum(axis=1) == bindings.unmet).all()
            assert ((met == UNKNOWN).any(axis=1) == bindings.unsure).all()
            few = bindings.select(bindings.unmet <= most)
            wanted |= set(zip(few.rows.tolist(), map(bytes, few.objects), strict=True))
        for bindings in find_bindings(indexed, attempts, most_unmet=most):
            found |= set(zip(bindings.rows.tolist(), map(bytes, bindings.objects), strict=True))
        assert found == wanted


@QUICK
@given(models(), st.integers(0, 10**6), st.integers(1, 200))
def test_the_size_of_the_blocks_does_not_matter(model: AbstractModel, seed: int, size: int) -> None:
    ground = GroundModel.of(model, DOMAIN.objects)
    states = kleene(ground.space, np.random.default_rng(seed))
    with pytest.MonkeyPatch.context() as patch:
        found = []
        for block in (joins.BLOCK, size):
            patch.setattr(joins, "BLOCK", block)
            found.append([v for bindings in ground.bind_all(states) for v in verdicts(bindings)])
        assert found[0] == found[1]


BLOCKS = tuple(Object(f"b{n}", ("block",)) for n in range(30))
CLEAR, ON = Predicate("clear", ("block",)), Predicate("on", ("block", "block"))
TOWER = AtomSpace((CLEAR, ON), BLOCKS)


def tower(height: int) -> Operator:
    """Lift a block and find out what lies below it, down to some depth."""
    names = [f"?b{n}" for n in range(height)]
    below = (Literal(Atom("on", (a, b))) for a, b in itertools.pairwise(names))
    return Operator(
        "Lift", "Lift", tuple(Variable(n, ("block",)) for n in names), 1,
        frozenset({Literal(Atom("clear", (names[0],))), *below}),
        frozenset({Absence(Atom("on", ("?any", names[0])), ("?any",))}),
        frozenset(), frozenset({Atom("on", (names[0], names[1]))}),
    )  # fmt: skip


def stacked() -> Labels:
    true = [Atom("clear", ("b0",)), *(Atom("on", (f"b{n}", f"b{n + 1}")) for n in range(29))]
    row = np.zeros((1, len(TOWER.atoms)), dtype=np.int8)
    row[0, TOWER.columns(true)] = TRUE
    return row


def test_parameters_are_joined_not_multiplied(monkeypatch: pytest.MonkeyPatch) -> None:
    """Seven parameters over thirty blocks: 10 billion combinations, one binding."""
    looked_up = 0
    select = Bindings.select

    def counting(self: Bindings, chosen: np.ndarray) -> Bindings:
        nonlocal looked_up
        looked_up += len(self)
        return select(self, chosen)

    monkeypatch.setattr(Bindings, "select", counting)
    model = GroundModel.from_operators([tower(7)], TOWER)
    (found,) = model.bind_all(stacked())
    assert found.objects.tolist() == [list(range(7))]
    assert looked_up < 7 * 2 * len(BLOCKS)


def test_different_parameters_are_different_objects() -> None:
    """D4"""
    model = GroundModel.from_operators([replace(tower(2), arity=2)], TOWER)
    unknown = np.full_like(stacked(), UNKNOWN)
    assert not list(model.bind(unknown, [SkillInstance("Lift", ("b0", "b0"))]))
    (found,) = model.bind(unknown, [SkillInstance("Lift", ("b0", "b1"))])
    assert found.objects.tolist() == [[0, 1]]
    model = GroundModel.from_operators([tower(2)], TOWER)
    (found,) = model.bind(unknown, [SkillInstance("Lift", ("b0",))])
    assert found.objects.tolist() == [[0, n] for n in range(1, 30)]


def test_an_absence_over_two_objects() -> None:
    """Nothing lies on anything, but for the operator's own block."""
    lonely = Operator(
        "Lift", "Lift", (Variable("?b", ("block",)),), 1, frozenset(),
        frozenset({Absence(Atom("on", ("?x", "?y")), ("?x", "?y"))}), frozenset(), frozenset(),
    )  # fmt: skip
    model = GroundModel.from_operators([lonely], AtomSpace((CLEAR, ON), BLOCKS[:4]))
    states = np.zeros((3, len(model.space.atoms)), dtype=np.int8)
    states[1, model.space.column[Atom("on", ("b1", "b2"))]] = TRUE
    states[2, model.space.column[Atom("on", ("b1", "b2"))]] = UNKNOWN
    found = {
        (row, objects[0], verdict)
        for row, objects, verdict, _ in (v for b in model.bind_all(states) for v in verdicts(b))
    }
    own = {(row, b, TRUE) for row in range(3) for b in ("b1", "b2")}
    others = {(0, b, TRUE) for b in ("b0", "b3")} | {(2, b, UNKNOWN) for b in ("b0", "b3")}
    assert found == own | others


def test_a_conditional_effect_spares_the_arguments_but_not_the_context() -> None:
    each = Variable("?each", ("block",))
    effect = ConditionalEffect(each, (), Literal(Atom("clear", ("?each",))))
    operator = Operator(
        "Lift", "Lift", (Variable("?a", ("block",)), Variable("?b", ("block",))), 1,
        frozenset({Literal(Atom("on", ("?a", "?b")))}), frozenset(), frozenset(), frozenset(),
        frozenset({effect}),
    )  # fmt: skip
    model = GroundModel.from_operators([operator], AtomSpace((CLEAR, ON), BLOCKS[:3]))
    state = np.zeros((1, len(model.space.atoms)), dtype=np.int8)
    state[0, model.space.column[Atom("on", ("b0", "b1"))]] = TRUE
    (bindings,) = model.bind_all(state)
    after = {str(a) for a in model.space.true_atoms(bindings.successors()[0])}
    assert after == {"on(b0, b1)", "clear(b1)", "clear(b2)"}

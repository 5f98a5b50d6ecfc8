"""PDDL without negation, disjunction and quantifiers means what the ground operators mean."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from model_strategies import DOMAIN, models
from pddl_readers import (
    read_with_pddl_library,
    read_with_translator,
    read_with_unified_planning,
)
from scalar_grounding import ground_operator
from unified_planning.engines.sequential_simulator import UPSequentialSimulator

from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.errors import SymbolError
from skillwrapper.grounding import TRUE, GroundModel
from skillwrapper.symbols import AbstractModel, Atom, ConditionalEffect, Literal, Variable
from skillwrapper.symbols.positive_pddl import PositivePddl

GOAL = (Literal(Atom("is_cut", ("lettuce",))), Literal(Atom("holding", ("robot", "patty")), False))
BEYOND = re.compile(r"\((?:forall|exists|or|imply|when|=)[\s)]|:(?:equality|negative\S*|disj\S*)")


def plain(model: AbstractModel) -> AbstractModel:
    """Without conditional effects."""
    operators = (replace(o, conditional_effects=frozenset()) for o in model.operators)
    return replace(model, operators=tuple(operators))


@settings(max_examples=25)
@given(models(), st.data())
def test_an_action_applies_where_the_operator_does(
    model: AbstractModel, data: st.DataObject
) -> None:
    model = plain(model)
    ground = GroundModel.of(model, DOMAIN.objects)
    row = np.zeros(len(ground.space.atoms), dtype=np.int8)
    if len(row):
        row[data.draw(st.lists(st.integers(0, len(row) - 1), max_size=3))] = TRUE
    printer = PositivePddl(model, DOMAIN.objects)
    texts = printer.domain(), printer.problem(ground.space.true_atoms(row), ())
    assert not BEYOND.search("".join(texts))
    problem = read_with_unified_planning(texts)
    simulator = UPSequentialSimulator(problem, error_on_failed_checks=False)
    state = simulator.get_initial_state()
    names = printer.names
    for operator in (g for o in model.operators for g in ground_operator(o, ground.space)):
        parts = [a for a in printer.actions if a.operator is operator.operator]
        arguments = [problem.object(names.objects[n]) for n in operator.arguments]
        applicable = [
            action
            for action in (problem.action(part.name) for part in parts)
            if simulator._is_applicable(state, action, arguments)
        ]
        assert len(applicable) == (operator.applicability(row[np.newaxis])[0] == TRUE)
        for action in applicable:
            after = simulator.apply_unsafe(state, action, arguments)
            expected = operator.apply(row[np.newaxis])[0]
            for atom, value in zip(ground.space.atoms, expected, strict=True):
                terms = [problem.object(names.objects[n]) for n in atom.terms]
                fluent = problem.fluent(names.predicates[atom.predicate])
                partner = problem.fluent(printer.partner(atom.predicate))
                assert after.get_value(fluent(*terms)).bool_constant_value() == bool(value)
                assert after.get_value(partner(*terms)).bool_constant_value() != bool(value)


def test_other_readers_take_it() -> None:
    model = expert_model()
    printer = PositivePddl(plain(model), model.domain.objects)
    texts = printer.domain(), printer.problem(expert_atoms(BurgerState()), GOAL)
    domain, _ = read_with_pddl_library(texts)
    assert len(domain.actions) == len(printer.actions)
    read_with_translator([texts])
    assert "(no_holding robot_2 patty)" in texts[1].partition(":goal")[2]


def test_what_changes_a_set_of_objects_is_refused() -> None:
    model = expert_model()
    first, *others = model.operators
    quantified = Variable("?any", ("pickupable",))
    effect = ConditionalEffect(quantified, (), Literal(Atom("nothing_on", ("?any",))))
    changed = replace(first, conditional_effects=frozenset({effect}))
    with pytest.raises(SymbolError, match=f"operator {first.name}: it changes every other object"):
        PositivePddl(replace(model, operators=(changed, *others)), model.domain.objects)


@settings(max_examples=25)
@given(models())
def test_no_object_is_of_a_type_that_has_subtypes(model: AbstractModel) -> None:
    """POPF 2 crashes where one is (found with a bun, a pickupable, beside patties, cookable)."""
    domain = PositivePddl(plain(model), DOMAIN.objects).domain()
    of = {n: dict(re.findall(r"(\S+) - (\S+)", s)) for n, s in _sections(domain).items()}
    assert len(of[":constants"]) == len(DOMAIN.objects)
    assert not {*of[":constants"].values()} & {*of[":types"].values()}
    assert {*of[":constants"].values()} <= {*of[":types"]}


def _sections(domain: str) -> dict[str, str]:
    return dict(re.findall(r"\((:types|:constants)(.*?)\n  \)", domain, re.S))

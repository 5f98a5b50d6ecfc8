"""The lifted PDDL means what our ground operators mean, by unified-planning's simulator."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from model_strategies import DOMAIN, models
from pddl_readers import read_with_unified_planning
from scalar_grounding import ground_operator
from unified_planning.engines.sequential_simulator import UPSequentialSimulator

from skillwrapper.grounding import TRUE, GroundModel, Labels
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
from skillwrapper.symbols.pddl import print_domain, print_problem
from skillwrapper.symbols.pddl_names import PlannerNames

NEAR, HOT = Predicate("near", ("item", "item")), Predicate("HOT", ("Hot-Thing",))
TAKE = Operator(
    "Take",
    "Take",
    (Variable("?robot", ("robot",)), Variable("?item", ("item",)), Variable("?to", ("food",))),
    2,
    frozenset({Literal(Atom("near", ("?item", "?to")), False)}),
    frozenset(
        {Absence(Atom("near", ("?x", "?item")), ("?x",)), Absence(Atom("HOT", ("?x",)), ("?x",))}
    ),
    frozenset({Atom("near", ("?item", "?to"))}),
    frozenset({Atom("near", ("?to", "?item"))}),
    frozenset(
        {
            ConditionalEffect(
                Variable("?x", ("item",)),
                (Literal(Atom("near", ("?x", "?to"))),),
                Literal(Atom("near", ("?x", "?to")), False),
            ),
            ConditionalEffect(Variable("?x", ("Hot-Thing",)), (), Literal(Atom("HOT", ("?x",)))),
        }
    ),
)
WITHOUT_ABSENCES = Operator(
    "Grab", "Take", TAKE.parameters, 2, TAKE.preconditions, frozenset(), TAKE.add_effects,
    TAKE.delete_effects, TAKE.conditional_effects,
)  # fmt: skip


@settings(max_examples=20)
@given(models(), st.data())
def test_any_model(model: AbstractModel, data: st.DataObject) -> None:
    compare(model, data, most=2)


@settings(max_examples=12)
@given(st.data())
def test_absences_and_conditional_effects(data: st.DataObject) -> None:
    compare(AbstractModel(DOMAIN, (NEAR, HOT), (TAKE, WITHOUT_ABSENCES)), data, most=4)


def compare(model: AbstractModel, data: st.DataObject, most: int) -> None:
    """Applicability and change of every ground operator in a state of a few true atoms."""
    ground = GroundModel.of(model, DOMAIN.objects)
    row = np.zeros(len(ground.space.atoms), dtype=np.int8)
    if len(row):
        row[data.draw(st.lists(st.integers(0, len(row) - 1), max_size=most))] = TRUE
    names = PlannerNames.of(model, DOMAIN.objects)
    simulator = simulate(model, ground, row)
    problem, state = simulator._problem, simulator.get_initial_state()
    for operator in (g for o in model.operators for g in ground_operator(o, ground.space)):
        action = problem.action(names.operators[operator.operator.name])
        arguments = [problem.object(names.objects[n]) for n in operator.arguments]
        applies = operator.applicability(row[np.newaxis])[0] == TRUE
        assert simulator._is_applicable(state, action, arguments) == applies
        if not applies:
            continue
        after = simulator.apply_unsafe(state, action, arguments)
        expected = operator.apply(row[np.newaxis])[0]
        for atom, value in zip(ground.space.atoms, expected, strict=True):
            fluent = problem.fluent(names.predicates[atom.predicate])
            terms = [problem.object(names.objects[n]) for n in atom.terms]
            assert after.get_value(fluent(*terms)).bool_constant_value() == bool(value)


def simulate(model: AbstractModel, ground: GroundModel, row: Labels) -> UPSequentialSimulator:
    problem = print_problem(model, DOMAIN.objects, ground.space.true_atoms(row), ())
    read = read_with_unified_planning((print_domain(model), problem))
    return UPSequentialSimulator(read, error_on_failed_checks=False)

"""The printed PDDL is what four different parsers take for PDDL, and means what the model says."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st
from model_strategies import DOMAIN, models
from pddl.formatter import domain_to_string
from pddl.parser.domain import DomainParser
from pddl.parser.problem import ProblemParser
from pddl_readers import read_with_translator, read_with_unified_planning

from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.symbols import AbstractModel, Atom, Literal, Predicate, Variable
from skillwrapper.symbols.operators import Absence, Operator
from skillwrapper.symbols.pddl import print_domain, print_problem

PARSE_DOMAIN, PARSE_PROBLEM = DomainParser(), ProblemParser()
GOAL = (Literal(Atom("is_cut", ("lettuce",))), Literal(Atom("holding", ("robot", "patty")), False))


def burger_problem() -> str:
    model = expert_model()
    return print_problem(model, model.domain.objects, expert_atoms(BurgerState()), GOAL)


def test_operator_as_pddl() -> None:
    text = print_domain(expert_model())
    assert (
        """
  (:action pick_from_table
    :parameters (?robot - robot ?item - pickupable)
    :precondition (and
      (hand_empty ?robot)
      (nothing_on ?item)
      (forall (?other - station) (not (on_station ?item ?other)))
      (forall (?other - pickupable) (or (= ?other ?item) (not (stacked_on ?item ?other))))
    )
    :effect (and
      (holding ?robot ?item)
      (not (hand_empty ?robot))
    )
  )
"""
        in text
    )
    assert "    cuttable - pickupable\n" in text
    assert "      (not (= ?item ?base))\n" in text


def test_overlapping_types_become_static_predicates() -> None:
    operator = Operator(
        "Touch",
        "Take",
        (Variable("?robot", ("robot",)), Variable("?item", ("Hot-Thing", "food"))),
        2,
        frozenset(),
        frozenset({Absence(Atom("near", ("?x", "?robot")), ("?x",))}),
        frozenset(),
        frozenset(),
    )
    vocabulary = (Predicate("near", ("Hot-Thing", "robot")), Predicate("light", ("item",)))
    model = AbstractModel(DOMAIN, vocabulary, (operator,))
    text = print_domain(model)
    assert "(hot-thing ?any - thing) ; something one should not touch" in text
    assert ":parameters (?robot - robot ?item - food)" in text
    assert "      (hot-thing ?item)\n" in text
    assert (
        "(forall (?x - thing) (or (= ?x ?robot) (= ?x ?item) (not (hot-thing ?x)) "
        "(not (near ?x ?robot))))" in text
    )
    problem = print_problem(model, DOMAIN.objects, (), ())
    assert "(hot-thing soup)" in problem
    assert "soup - food" in problem


def test_same_model_same_text() -> None:
    model = expert_model()
    turned = AbstractModel(model.domain, model.predicates[::-1], model.operators[::-1])
    assert print_domain(turned) == print_domain(model)


@settings(max_examples=25, deadline=None)
@given(models())
def test_print_parse_print_through_the_pddl_library(model: AbstractModel) -> None:
    parsed = PARSE_DOMAIN(print_domain(model))
    again = PARSE_DOMAIN(domain_to_string(parsed))
    assert again == parsed
    assert domain_to_string(again) == domain_to_string(parsed)
    assert len(parsed.actions) == len(model.operators)


@settings(max_examples=25, deadline=None)
@given(models(), st.data())
def test_problem_parses(model: AbstractModel, data: st.DataObject) -> None:
    atoms = [a for p in model.predicates for a in p.groundings(DOMAIN.objects)]
    some = st.lists(st.sampled_from(atoms), max_size=5, unique=True) if atoms else st.just([])
    goal = [Literal(a, data.draw(st.booleans())) for a in data.draw(some)]
    true = data.draw(some)
    problem = PARSE_PROBLEM(print_problem(model, DOMAIN.objects, true, goal))
    assert len(problem.objects) == len(DOMAIN.objects)
    assert len(problem.init) >= len(true)


@settings(max_examples=15, deadline=None)
@given(models())
def test_unified_planning_reads_it(model: AbstractModel) -> None:
    read_with_unified_planning((print_domain(model), print_problem(model, DOMAIN.objects, (), ())))


def test_unified_planning_reads_burger() -> None:
    problem = read_with_unified_planning((print_domain(expert_model()), burger_problem()))
    assert len(problem.actions) == 7


@settings(max_examples=1, deadline=None)
@given(st.lists(models(), min_size=10, max_size=20))
def test_fast_downwards_translator_reads_it(drawn: list[AbstractModel]) -> None:
    texts = [(print_domain(m), print_problem(m, DOMAIN.objects, (), ())) for m in drawn]
    read_with_translator([*texts, (print_domain(expert_model()), burger_problem())])

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_kitchen import START, labels, space

from skillwrapper.errors import GoalError, UnknownNameError
from skillwrapper.grounding import AtomSpace
from skillwrapper.planning import goal_from_state, parse_goal
from skillwrapper.symbols import Literal, Predicate
from skillwrapper.symbols.predicates import Atom

WANTED = {
    Literal(Atom("is_cut", ("lettuce",))),
    Literal(Atom("holding", ("robot", "patty")), False),
}


@pytest.mark.parametrize(
    "text",
    [
        "(and (is_cut lettuce) (not (holding robot patty)))",
        "(and(is_cut lettuce)(not(holding robot patty)))",
        "is_cut(lettuce), not holding(robot, patty)",
        "is_cut(lettuce) and not (holding robot patty)",
        "(is_cut lettuce) (not holding(robot, patty))",
        "(and (and is_cut(lettuce)) (and (not (holding robot patty))))",
        "(is_cut (lettuce)) (not (holding robot, patty))",
        "  is_cut ( lettuce )\n and\n not holding (robot patty)",
    ],
)
def test_ways_to_write_one_goal(text: str) -> None:
    assert parse_goal(text, space()) == WANTED


def test_nullary_predicates() -> None:
    camp = AtomSpace((Predicate("raining", ()), Predicate("cold", ())), ())
    wanted = {Literal(Atom("raining")), Literal(Atom("cold"), False)}
    for text in ("(and (raining) (not (cold)))", "raining and not cold", "raining(), not cold()"):
        assert parse_goal(text, camp) == wanted


@settings(max_examples=50, deadline=None)
@given(st.sets(st.integers(0, len(space().atoms) - 1), min_size=1), st.data())
def test_printed_literals_are_read_back(columns: set[int], data: st.DataObject) -> None:
    goal = {Literal(space().atoms[column], data.draw(st.booleans())) for column in columns}
    assert parse_goal(", ".join(map(str, sorted(goal))), space()) == goal


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(is_cutt lettuce)", "unknown predicate 'is_cutt'; did you mean 'is_cut'?"),
        ("(is_cut letuce)", "unknown object 'letuce'; did you mean 'lettuce'?"),
        ("(is_cut lettuce board)", r"expected 1 argument\(s\) as in is_cut\(\?cuttable\), got 2"),
        ("holding(robot)", "expected 2 argument"),
        ("(is_cut stove)", r"expected a cuttable .* got 'stove' \(cooker, station\).*: lettuce"),
        ("(stacked_on patty patty)", "expected different objects"),
        ("(and (is_cut lettuce) (not (is_cut lettuce)))", "both true and false"),
        ("", "expected a literal, got nothing"),
        ("(and)", "expected a literal, got nothing"),
        ("(is_cut lettuce", r"got the end; write e\.g\."),
        ("(and (is_cut lettuce)", "got the end"),
        ("is_cut(lettuce))", r"got \)"),
        ("(not (and (is_cut lettuce) (is_cooked patty)))", "one literal after 'not'"),
        ("(or (is_cut lettuce) (is_cooked patty))", "unknown predicate 'or'|expected"),
    ],
)
def test_goals_that_are_none(text: str, expected: str) -> None:
    with pytest.raises((GoalError, UnknownNameError), match=expected):
        parse_goal(text, space())


@settings(max_examples=200, deadline=None)
@given(st.lists(st.sampled_from(["(", ")", ",", "and", "not", "is_cut", "lettuce", "x"])))
def test_nonsense_is_a_goal_or_an_error_of_ours(tokens: list[str]) -> None:
    with suppress(GoalError, UnknownNameError):
        assert parse_goal(" ".join(tokens), space())


def test_goal_from_a_state() -> None:
    row = labels(START)
    row[space().column[Atom("is_cut", ("lettuce",))]] = -1
    everything = goal_from_state(space(), row)
    assert len(everything) == len(space().atoms) - 1
    positive = goal_from_state(space(), row, positive_only=True)
    assert positive == {literal for literal in everything if literal.positive}
    assert {literal.atom for literal in positive} == space().true_atoms(row)
    assert not goal_from_state(space(), np.full_like(row, -1))

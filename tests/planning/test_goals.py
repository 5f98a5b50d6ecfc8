"""Goals mean what PDDL says, in whatever style they are written, or are refused with the place.

From a fault found by use: ``(AND ...)``, ``or``, ``forall``, comments and ``(:goal ...)`` were
taken for predicates, and deep nesting ended in a RecursionError.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_kitchen import START, labels, space

from skillwrapper.errors import GoalError, UnknownNameError
from skillwrapper.grounding import AtomSpace
from skillwrapper.planning import Goal, goal_from_state, parse_goal
from skillwrapper.symbols import Literal, Predicate
from skillwrapper.symbols.predicates import Atom
from skillwrapper.world import Object

CUT = Literal(Atom("is_cut", ("lettuce",)))
COOKED = Literal(Atom("is_cooked", ("patty",)))
NOT_HOLDING = Literal(Atom("holding", ("robot", "patty")), False)
BOTH = Goal.all_of([CUT, NOT_HOLDING])


@pytest.mark.parametrize(
    "text",
    [
        "(and (is_cut lettuce) (not (holding robot patty)))",
        "(and(is_cut lettuce)(not(holding robot patty)))",
        "is_cut(lettuce), not holding(robot, patty)",
        "is_cut(lettuce) and not (holding robot patty)",
        "is_cut(lettuce), and not holding(robot patty)",
        "(is_cut lettuce) (not holding(robot, patty))",
        "(and (and is_cut(lettuce)) (and (not (holding robot patty))))",
        "(is_cut (lettuce)) (not (holding robot, patty))",
        "  is_cut ( lettuce )\n and\n not holding (robot patty)",
        "(AND (IS_CUT Lettuce) (Not (holding ROBOT patty)))",
        "(:goal (and (is_cut lettuce) (not (holding robot patty))))",
        "(:GOAL (is_cut lettuce) (not (holding robot patty)))",
        ":goal (and (is_cut lettuce) (not (holding robot patty)))",
        "; wanted\n(and ; all of it (really)\n(is_cut lettuce);\n(not (holding robot patty)))",
        "and(is_cut(lettuce), not(holding(robot, patty)))",
        "((is_cut lettuce)) (not (not (not (holding robot patty))))",
        "not (or (not is_cut(lettuce)) holding(robot, patty))",
        "(not (imply (is_cut lettuce) (holding robot patty)))",
        "(not (or (not (is_cut lettuce)) (holding robot patty)))",
        "(forall (?x - cuttable) (and (is_cut ?x) (not (holding robot patty))))",
        "(and (forall (?X - Cuttable ?r - robot) (is_cut ?x)) (not (holding robot patty)))",
        "(and (is_cut lettuce) (not (exists (?r - robot) (holding ?r patty))))",
        "(exists (?x - cuttable ?y - (either cookable)) (and is_cut(?x) (not (holding robot ?y))))",
        "(forall (?x) (imply (= ?x lettuce) (and (is_cut lettuce) (not (holding robot patty)))))",
        "(and (is_cut lettuce) (not (= patty lettuce)) (not (holding robot patty)))",
        "(or (= patty lettuce) (and (is_cut lettuce) (not (holding robot patty))))",
        "(exists (?x - object) (and (= ?x lettuce) (is_cut lettuce) (not (holding robot patty))))",
        "(or (and (is_cut lettuce) (not (holding robot patty))) "
        "(and (is_cut lettuce) (not (holding robot patty)) (is_cooked patty)))",
    ],
)
def test_ways_to_write_one_goal(text: str) -> None:
    assert parse_goal(text, space()) == BOTH


@pytest.mark.parametrize(
    "text",
    [
        "(or (is_cut lettuce) (is_cooked patty))",
        "(OR (is_cut lettuce) (is_cooked patty) (is_cut lettuce))",
        "is_cut(lettuce) or is_cooked(patty)",
        "is_cut(lettuce), or is_cooked(patty)",
        "or(is_cut(lettuce), is_cooked(patty))",
        "(or is_cut(lettuce), is_cooked(patty))",
        "(imply (not (is_cut lettuce)) (is_cooked patty))",
        "imply(not is_cut(lettuce), is_cooked(patty))",
        "(not (and (not (is_cut lettuce)) (not (is_cooked patty))))",
        "(exists (?x - cuttable ?y - cookable) (or (is_cut ?x) (is_cooked ?y)))",
    ],
)
def test_ways_to_write_one_choice(text: str) -> None:
    assert set(parse_goal(text, space()).alternatives) == {frozenset({CUT}), frozenset({COOKED})}


def test_nullary_predicates() -> None:
    camp = AtomSpace((Predicate("raining", ()), Predicate("cold", ())), ())
    wanted = Goal.all_of([Literal(Atom("raining")), Literal(Atom("cold"), False)])
    for text in ("(and (raining) (not (cold)))", "raining and not cold", "raining(), not cold()"):
        assert parse_goal(text, camp) == wanted


def test_predicates_named_like_words_of_pddl() -> None:
    names = ("at", "and", "not", "or", "forall", "when", "within", "On", "on")
    objects = (Object("a", ("item",)), Object("b", ("item",)))
    odd = AtomSpace(tuple(Predicate(name, ("item", "item")) for name in names), objects)
    for name in names:
        wanted = Goal.all_of([Literal(Atom(name, ("a", "b")))])
        for text in (f"({name} a b)", f"{name}(a, b)", f"(and ({name} a b))"):
            assert parse_goal(text, odd) == wanted
    with pytest.raises(UnknownNameError, match="'ON'"):
        parse_goal("(ON a b)", odd)


@settings(max_examples=50)
@given(st.sets(st.integers(0, len(space().atoms) - 1), min_size=1), st.data())
def test_printed_literals_are_read_back(columns: set[int], data: st.DataObject) -> None:
    goal = [Literal(space().atoms[column], data.draw(st.booleans())) for column in columns]
    assert parse_goal(", ".join(map(str, sorted(goal))), space()) == Goal.all_of(goal)


THINGS = tuple(
    Object(name, types)
    for name, types in {
        "a": ("block", "item"),
        "b": ("block", "item"),
        "c": ("item",),
        "t": ("place",),
    }.items()
)
TABLE = AtomSpace(
    (
        Predicate("on", ("item", "item")),
        Predicate("red", ("block",)),
        Predicate("at", ("item", "place")),
    ),
    THINGS,
)
RANGES = {"block": "ab", "item": "abc", "(either block place)": "abt", "object": "abct"}
Meaning = tuple[str, Callable[[set[tuple[str, ...]], dict[str, str]], bool]]
"""A formula as text, and a function from a state and a binding to its truth."""


@st.composite
def atoms(draw: st.DrawFn, scope: tuple[tuple[str, str], ...]) -> Meaning:
    """A random condition on objects and variables."""
    items = [*"abc", *(v for v, kind in scope if kind in ("block", "item"))]
    blocks = [*"ab", *(v for v, kind in scope if kind == "block")]
    x, y = draw(st.permutations(items))[:2]
    red = draw(st.sampled_from(blocks))
    one, two = (draw(st.sampled_from([*items, "t"])) for _ in "12")
    meanings: list[Meaning] = [
        (f"(on {x} {y})", lambda s, b: ("on", b.get(x, x), b.get(y, y)) in s),
        (f"(at {x} t)", lambda s, b: ("at", b.get(x, x), "t") in s),
        (f"(red {red})", lambda s, b: ("red", b.get(red, red)) in s),
        (f"(= {one} {two})", lambda s, b: b.get(one, one) == b.get(two, two)),
    ]
    return draw(st.sampled_from(meanings))


@st.composite
def formulas(draw: st.DrawFn, scope: tuple[tuple[str, str], ...] = (), depth: int = 3) -> Meaning:
    """A random formula beside its truth, which is worked out with no code of ours."""
    if not depth or draw(st.integers(0, 3)) == 0:
        return draw(atoms(scope))
    word = draw(st.sampled_from(["not", "and", "or", "imply", "forall", "exists"]))
    combine = all if word in ("and", "forall") else any
    if word in ("forall", "exists"):
        variable, kind = f"?v{depth}", draw(st.sampled_from(sorted(RANGES)))
        text, truth = draw(formulas((*scope, (variable, kind)), depth - 1))
        return (
            f"({word} ({variable} - {kind}) {text})",
            lambda s, b: combine(truth(s, {**b, variable: name}) for name in RANGES[kind]),
        )
    number = {"not": 1, "imply": 2}.get(word) or draw(st.integers(1, 3))
    texts, truths = zip(*(draw(formulas(scope, depth - 1)) for _ in range(number)), strict=True)
    text = f"({word} {' '.join(texts)})"
    if word == "not":
        return text, lambda s, b: not truths[0](s, b)
    if word == "imply":
        return text, lambda s, b: not truths[0](s, b) or truths[1](s, b)
    return text, lambda s, b: combine(truth(s, b) for truth in truths)


@settings(max_examples=150)
@given(formulas(), st.lists(st.sets(st.integers(0, len(TABLE.atoms) - 1)), min_size=5, max_size=5))
def test_meaning_of_any_formula(formula: Meaning, states: list[set[int]]) -> None:
    text, truth = formula
    goal = Goal(())
    with suppress(GoalError):  # no state of this scene can meet it
        goal = parse_goal(text, TABLE)
    for columns in states:
        row = np.zeros(len(TABLE.atoms), dtype=np.int8)
        row[sorted(columns)] = 1
        true = {(TABLE.atoms[c].predicate, *TABLE.atoms[c].terms) for c in columns}
        assert goal.holds(TABLE, row) == truth(true, {})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(is_cutt lettuce)", "unknown predicate 'is_cutt'; did you mean 'is_cut'?"),
        ("(is_cut letuce)", "unknown object 'letuce'; did you mean 'lettuce'?"),
        ("(and\n  (is_cut\n letuce))", "line 3, column 2: unknown object"),
        ("(is_cut lettuce board)", r"expected 1 argument\(s\) as in is_cut\(\?cuttable\), got 2"),
        ("holding(robot)", "expected 2 argument"),
        ("(is_cut stove)", r"expected a cuttable .* got 'stove' \(cooker, station\).*: lettuce"),
        ("(stacked_on patty patty)", "expected different objects"),
        ("(exists (?x - pickupable) (stacked_on ?x ?x))", "expected different objects"),
        ("(and (is_cut lettuce) (not (is_cut lettuce)))", "both true and false"),
        ("(and (or (is_cut lettuce)) (not (is_cut lettuce)))", "both true and false"),
        ("(= patty lettuce)", "no state of this scene can meet it"),
        ("", "expected a literal, got nothing"),
        ("; nothing", "expected a literal, got nothing"),
        ("()", "expected a literal, got nothing"),
        ("(and)", "expected a literal, got nothing"),
        ("(or)", "expected a literal, got nothing"),
        ("(:goal)", "expected a literal, got nothing"),
        ("(:goal ())", "expected a literal, got nothing"),
        ("(not)", "expected a literal, got the end"),
        ("is_cut(lettuce),", "expected a literal, got the end"),
        ("(is_cut lettuce", r"line 1, column 1: .*got the end; write e\.g\."),
        ("(and (is_cut lettuce)", "got the end"),
        ("is_cut(lettuce))", r"column 16: .*got \)"),
        ("(not (is_cut lettuce) (is_cooked patty))", "one literal after 'not'"),
        ("(imply (is_cut lettuce))", "two conditions after 'imply', got one"),
        ("(imply (is_cut lettuce) (is_cooked patty) (is_cut lettuce))", "got more"),
        ("(= patty)", "two objects after '=', got 1"),
        ("(forall (is_cut lettuce))", r"a variable such as \?x, got is_cut"),
        ("(forall ?x - cuttable (is_cut ?x))", "got no variables"),
        ("(forall (?x - cuttable))", "one condition after the variables, got none"),
        ("(forall (?x - cuttable) (is_cut ?x) (is_cut lettuce))", "got more"),
        ("(forall (?x - cutable) (is_cut ?x))", "unknown type 'cutable'; did you mean 'cuttable'?"),
        ("(forall (?x -) (is_cut ?x))", "a type after '-'"),
        ("(forall (?x - pickupable) (is_cut ?x))", r"for \?x; write \(\?x - cuttable\)"),
        ("(forall (?x) (is_cut ?x))", r"write \(\?x - cuttable\)"),
        ("(forall (?x - cuttable) (is_cut ?y))", r"a variable of a forall or exists, got \?y"),
        ("(is_cut ?x)", r"a variable of a forall or exists, got \?x"),
        ("(preference p (is_cut lettuce))", "'preference' is not supported in goals; use and"),
        ("(>= (total-cost) 3)", "'>=' is not supported"),
        ("(define (problem p) (:goal (is_cut lettuce)))", "'define' is not supported"),
        ("(:init (is_cut lettuce))", "':init' is not supported"),
        ("is_cut(lettuce) and is_cooked(patty) or is_cut(lettuce)", "parentheses around"),
        ("is_cut(lettuce) and forall (?x - cuttable) (is_cut ?x)", "parentheses around 'forall"),
        ("is_cut(lettuce) and and is_cooked(patty) and", "got the end"),
        ("(is_cut (and lettuce))", "expected an object|unknown"),
    ],
)
def test_goals_that_are_none(text: str, expected: str) -> None:
    with pytest.raises((GoalError, UnknownNameError), match=expected) as raised:
        parse_goal(text, space())
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("words", ["(", "(not ", "(and ", "((", ")", "not ", "(forall (?x) "])
def test_deep_nesting(words: str) -> None:
    for closed in (words * 50_000, words * 50_000 + "(is_cut lettuce)" + ")" * 50_000):
        with pytest.raises((GoalError, UnknownNameError)):
            parse_goal(closed, space())


def test_nesting_that_is_no_trouble() -> None:
    text = "(not (and " * 40 + "(is_cut lettuce)" + "))" * 40
    assert parse_goal(text, space()) == Goal.all_of([CUT])
    assert parse_goal("not " * 40_000 + "is_cut(lettuce)", space()) == Goal.all_of([CUT])


def many(number: int) -> AtomSpace:
    objects = tuple(Object(f"x{n}", ("item",)) for n in range(number))
    return AtomSpace((Predicate("p", ("item",)), Predicate("q", ("item",))), objects)


def test_many_alternatives_are_refused_in_time() -> None:
    started = time.process_time()
    few = parse_goal("(forall (?x - item) (or (p ?x) (q ?x)))", many(9))
    assert len(few.alternatives) == 2**9
    for number, text in (
        (40, "(forall (?x - item) (or (p ?x) (q ?x)))"),
        (100, "(exists (?x ?y ?z - item) (and (p ?x) (p ?y) (p ?z)))"),
        (40, "(exists (?a ?b ?c ?d ?e ?f - item) (p ?a))"),
    ):
        with pytest.raises(GoalError, match="more than"):
            parse_goal(text, many(number))
    assert time.process_time() - started < 20


def test_quantifier_over_a_type_that_nothing_in_the_scene_has() -> None:
    with pytest.raises(UnknownNameError, match="unknown type 'knife'"):
        parse_goal("(forall (?x - knife) (p x0))", many(2))
    assert parse_goal("(forall (?x - knife) (p x0))", many(2), ["knife"]) == Goal((frozenset(),))
    with pytest.raises(GoalError, match="no state of this scene"):
        parse_goal("(exists (?x - knife) (p x0))", many(2), ["knife"])


WORDS = [*"(),=-;\n", "and", "or", "not", "imply", "forall", "exists", ":goal"]
NAMES = ["?x", "cuttable", "is_cut", "stacked_on", "lettuce", "patty", "x", "AND"]


@settings(max_examples=300)
@given(st.lists(st.sampled_from(WORDS + NAMES), max_size=14))
def test_nonsense_is_a_goal_or_an_error_of_ours(tokens: list[str]) -> None:
    with suppress(GoalError, UnknownNameError):
        assert parse_goal(" ".join(tokens), space()).alternatives


def test_short_nonsense() -> None:
    for tokens in itertools.product([*WORDS, "?x", "is_cut", "lettuce"], repeat=3):
        with suppress(GoalError, UnknownNameError):
            assert parse_goal(" ".join(tokens), space()).alternatives


@settings(max_examples=100)
@given(st.text(max_size=30))
def test_any_text_is_a_goal_or_an_error_of_ours(text: str) -> None:
    with suppress(GoalError, UnknownNameError):
        assert parse_goal(text, space()).alternatives


def test_goal_from_a_state() -> None:
    row = labels(START)
    row[space().column[Atom("is_cut", ("lettuce",))]] = -1
    (everything,) = goal_from_state(space(), row).alternatives
    assert len(everything) == len(space().atoms) - 1
    (positive,) = goal_from_state(space(), row, positive_only=True).alternatives
    assert positive == {literal for literal in everything if literal.positive}
    assert {literal.atom for literal in positive} == space().true_atoms(row)
    assert goal_from_state(space(), np.full_like(row, -1)) == Goal((frozenset(),))


def test_goal_as_text() -> None:
    goal = parse_goal("(or (is_cut lettuce) (and (is_cooked patty) (hand_empty robot)))", space())
    assert str(goal) == "is_cut(lettuce), or hand_empty(robot) and is_cooked(patty)"

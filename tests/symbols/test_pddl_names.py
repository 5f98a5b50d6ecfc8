"""Every name that a user or a model can give survives three independent readers of PDDL.

From a fault found by use: a type named ``thing`` was declared as ``thing_2`` and used as ``thing``.
"""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from named_forest import WORDS, everywhere, forest, in_turn, printed
from pddl_readers import (
    read_with_pddl_library,
    read_with_translator,
    read_with_unified_planning,
)

from skillwrapper.errors import SymbolError
from skillwrapper.symbols import (
    AbstractModel,
    Predicate,
)
from skillwrapper.symbols.pddl import print_domain, print_problem
from skillwrapper.symbols.pddl_names import PlannerNames
from skillwrapper.world import Domain, Object, TypeHierarchy


def check(model: AbstractModel) -> None:
    domain, problem = read_with_pddl_library(printed(model))
    names = PlannerNames.of(model, model.domain.objects)
    for kind in (names.types, names.predicates, names.operators, names.objects):
        assert len(set(kind.values())) == len(kind)
    assert {str(a.name) for a in domain.actions} == set(names.operators.values())
    assert {str(o.name) for o in problem.objects} == set(names.objects.values())
    assert {str(p.name) for p in domain.predicates} >= set(names.predicates.values())
    again = read_with_unified_planning(printed(model))
    assert {o.name for o in again.all_objects} == set(names.objects.values())


@pytest.mark.parametrize("number", range(len(WORDS)), ids=WORDS)
def test_every_word_at_every_place(number: int) -> None:
    check(in_turn(number))


@pytest.mark.parametrize("word", ["and", "object", "thing", "A"])
def test_one_word_everywhere(word: str) -> None:
    check(everywhere(word))


def test_words_of_planning_for_the_translator() -> None:
    models = [*map(in_turn, range(len(WORDS))), *map(everywhere, WORDS)]
    read_with_translator(map(printed, models))


NAMES = st.sampled_from(WORDS) | st.from_regex(r"[A-Za-z][A-Za-z0-9_-]{0,5}", fullmatch=True)
WILD = NAMES | st.text(max_size=5)
"""Also what is no name anywhere; types and objects can come from programs, not from files only."""


@st.composite
def forests(draw: st.DrawFn) -> AbstractModel:
    types = tuple(draw(st.lists(WILD, min_size=3, max_size=3, unique=True)))
    one, two = draw(st.lists(WILD, min_size=2, max_size=2, unique=True))
    predicates = draw(st.lists(NAMES, min_size=2, max_size=2, unique=True))
    return forest(types, (one, two, *predicates, draw(WILD)), draw(st.booleans()))


@settings(max_examples=10, deadline=None)
@given(forests())
def test_any_names(model: AbstractModel) -> None:
    check(model)


@settings(max_examples=1, deadline=None)
@given(st.lists(forests(), min_size=20, max_size=40))
def test_any_names_for_the_translator(models: list[AbstractModel]) -> None:
    read_with_translator(map(printed, models))


def test_altered_names_are_listed() -> None:
    text = print_domain(forest(("and", "bird", "Wet"), ("b1", "b2", "On", "or", "feed")))
    head = text.split("(:requirements")[0]
    assert "; type and is written and_2" in head
    assert "; predicate or is written or_2" in head
    assert "On" not in head
    assert "Wet" not in head


def test_all_declared_types_are_written() -> None:
    """From a fault found by use: objects of a type that no parameter uses did not fit."""
    hierarchy = TypeHierarchy({"item": (), "food": ("item",), "tool": ("item",), "sign": ()})
    objects = (Object("saw", ("item", "tool")), Object("exit", ("sign",)))
    domain = Domain("shop", "a robot", "a shop", hierarchy, objects, ())
    for used in itertools.chain([()], itertools.combinations(("item", "food", "sign"), 2)):
        vocabulary = tuple(Predicate(f"p_{name}", (name,)) for name in used)
        model = AbstractModel(domain, vocabulary, ())
        new = Object("bread", ("food", "item"))
        texts = print_domain(model), print_problem(model, (*objects, new), (), ())
        parsed, problem = read_with_pddl_library(texts)
        assert {str(name) for name in parsed.types} >= {"item", "food", "tool", "sign"}
        assert {str(o.name): {str(t) for t in o.type_tags} for o in problem.objects} == {
            "saw": {"tool"},
            "exit": {"sign"},
            "bread": {"food"},
        }


def test_type_with_two_parents_and_no_object() -> None:
    hierarchy = TypeHierarchy(
        {"holder": (), "item": (), "mug": ("holder", "item"), "cup": ("mug",)}
    )
    domain = Domain("shop", "a robot", "a shop", hierarchy, (), ())
    model = AbstractModel(domain, (Predicate("full", ("mug",)), Predicate("on", ("item",))), ())
    cup = Object("cup1", ("cup", "holder", "item", "mug"))
    texts = print_domain(model), print_problem(model, [cup], (), ())
    assert "(holder cup1)" in texts[1]
    assert "cup - mug" in texts[0]
    assert "mug - item" in texts[0]
    read_with_pddl_library(texts)
    read_with_unified_planning(texts)


def test_object_of_two_types_that_the_tree_keeps_apart() -> None:
    hierarchy = TypeHierarchy({"plant": (), "stone": ()})
    model = AbstractModel(Domain("d", "a", "b", hierarchy, (), ()), (), ())
    with pytest.raises(SymbolError, match="'coral': its types 'plant' and 'stone' never come"):
        print_problem(model, [Object("coral", ("plant", "stone"))], (), ())

"""Rules that a prompt tells, in the words in which operators are described."""

from __future__ import annotations

import pytest

from skillwrapper.symbols import Absence, Atom, ConditionalEffect, Literal, Operator, Variable
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.vlm.embedded.prompt_text import WrittenCall
from skillwrapper.vlm.embedded.told_rules import MANY, Facts, ToldRule, told_rules

OBJECTS = {
    "robot": frozenset({"robot"}),
    "patty": frozenset({"pickupable", "cookable"}),
    "bun": frozenset({"pickupable"}),
    "leaf": frozenset({"pickupable"}),
    "stove": frozenset({"station"}),
}
ROBOT, ITEM = Variable("?robot", ("robot",)), Variable("?item", ("pickupable",))
PLACE = Variable("?place", ("station",))
PICK = Operator(
    name="Pick_1",
    skill="Pick",
    parameters=(ROBOT, ITEM, PLACE),
    arity=2,
    preconditions=frozenset(
        {Literal(Atom("on", ("?item", "?place"))), Literal(Atom("full", ("?robot",)), False)}
    ),
    absences=frozenset({Absence(Atom("atop", ("?any", "?item")), ("?any",))}),
    add_effects=frozenset({Atom("full", ("?robot",))}),
    delete_effects=frozenset({Atom("on", ("?item", "?place"))}),
    conditional_effects=frozenset(
        {
            ConditionalEffect(
                Variable("?other", ("pickupable",)),
                (Literal(Atom("near", ("?item", "?other"))),),
                Literal(Atom("near", ("?item", "?other")), False),
            )
        }
    ),
)
CALL = WrittenCall("Pick", ("robot", "patty"))


def fact(name: str, *terms: str) -> WrittenCall:
    return WrittenCall(name, terms)


def told(*operators: Operator) -> tuple[ToldRule, ...]:
    """As the proposal prompt shows them."""
    return told_rules("\n".join(f"- {describe_operator(o)}" for o in operators).split("\n"))


def imagine(*facts: WrittenCall) -> tuple[int, Facts]:
    (rule,) = told(PICK)
    return rule.imagine(CALL, frozenset(facts), OBJECTS)


def test_a_rule_that_applies_changes_what_it_says() -> None:
    before = [fact("on", "patty", "stove"), fact("near", "patty", "bun"), fact("near", "bun", "x")]
    assert imagine(*before) == (0, {fact("full", "robot"), fact("near", "bun", "x")})


@pytest.mark.parametrize(
    "obstacle", [fact("full", "robot"), fact("atop", "bun", "patty"), fact("atop", "leaf", "patty")]
)
def test_needs_that_are_not_met_are_counted(obstacle: WrittenCall) -> None:
    on = fact("on", "patty", "stove")
    assert imagine(on)[0] == 0
    assert imagine(on, obstacle)[0] == 1
    assert imagine(obstacle)[0] >= MANY


def test_an_absence_is_about_other_objects_alone() -> None:
    elsewhere = fact("atop", "patty", "bun")
    assert imagine(fact("on", "patty", "stove"), elsewhere)[0] == 0


def test_a_call_on_other_types_is_not_spoken_of() -> None:
    (rule,) = told(PICK)
    unmet, _ = rule.imagine(WrittenCall("Pick", ("robot", "stove")), frozenset(), OBJECTS)
    assert unmet >= MANY


def test_a_rule_without_needs_and_changes() -> None:
    nothing: frozenset[Atom] = frozenset()
    bare = Operator("Pick_1", "Pick", (ROBOT, ITEM), 2, frozenset(), frozenset(), nothing, nothing)
    rules = told(bare, PICK)
    assert [rule.skill for rule in rules] == ["Pick", "Pick"]
    assert rules[0].imagine(CALL, frozenset(), OBJECTS) == (0, frozenset())


def test_other_words_are_passed_over() -> None:
    assert told_rules(["(none)", "- Pick works if you are lucky.", "  needs luck"]) == ()

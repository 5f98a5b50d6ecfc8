"""Rules that a prompt tells, in the words in which operators are described."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import pytest

from skillwrapper.embedded.prompt_text import WrittenCall
from skillwrapper.embedded.told_rules import MANY, Imagined, ToldRule, told_rules
from skillwrapper.symbols import Absence, Atom, ConditionalEffect, Literal, Operator, Variable
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.symbols.operators import Condition

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


def told(*operators: Operator, untested: Collection[Condition] = ()) -> tuple[ToldRule, ...]:
    """As the proposal prompt shows them."""
    described = (describe_operator(o, untested) for o in operators)
    return told_rules("\n".join(f"- {text}" for text in described).split("\n"))


def imagine(*facts: WrittenCall) -> Imagined:
    (rule,) = told(PICK)
    return rule.imagine(CALL, frozenset(facts), OBJECTS)


def test_a_rule_that_applies_changes_what_it_says() -> None:
    before = [fact("on", "patty", "stove"), fact("near", "patty", "bun"), fact("near", "bun", "x")]
    after = frozenset({fact("full", "robot"), fact("near", "bun", "x")})
    assert imagine(*before) == Imagined(0, after)


@pytest.mark.parametrize(
    "obstacle", [fact("full", "robot"), fact("atop", "bun", "patty"), fact("atop", "leaf", "patty")]
)
def test_needs_that_are_not_met_are_counted(obstacle: WrittenCall) -> None:
    on = fact("on", "patty", "stove")
    assert imagine(on).unmet == 0
    assert imagine(on, obstacle).unmet == 1
    assert imagine(obstacle).unmet >= MANY


def test_an_absence_is_about_other_objects_alone() -> None:
    elsewhere = fact("atop", "patty", "bun")
    assert imagine(fact("on", "patty", "stove"), elsewhere).unmet == 0


def test_a_call_on_other_types_is_not_spoken_of() -> None:
    (rule,) = told(PICK)
    imagined = rule.imagine(WrittenCall("Pick", ("robot", "stove")), frozenset(), OBJECTS)
    assert imagined.unmet >= MANY


def test_a_rule_without_needs_and_changes() -> None:
    nothing: frozenset[Atom] = frozenset()
    bare = Operator("Pick_1", "Pick", (ROBOT, ITEM), 2, frozenset(), frozenset(), nothing, nothing)
    rules = told(bare, PICK)
    assert [rule.skill for rule in rules] == ["Pick", "Pick"]
    assert rules[0].imagine(CALL, frozenset(), OBJECTS) == Imagined(0, frozenset())


def test_a_need_that_only_may_matter_is_a_doubt_where_it_alone_is_unmet() -> None:
    full, on = Literal(Atom("full", ("?robot",)), False), fact("on", "patty", "stove")
    (rule,) = told(PICK, untested=[full])
    (doubt,) = rule.imagine(CALL, frozenset({on, fact("full", "robot")}), OBJECTS).doubts
    assert doubt[0] == "Pick_1"
    assert not doubt[1].sure
    for facts in ({on}, {fact("full", "robot")}, {on, fact("atop", "bun", "patty")}):
        assert not rule.imagine(CALL, frozenset(facts), OBJECTS).doubts


def test_types_that_only_may_matter() -> None:
    cookable = Variable("?item", ("cookable",))
    pick = replace(PICK, parameters=(ROBOT, cookable, PLACE))
    on = frozenset({fact("on", "bun", "stove")})
    call = WrittenCall("Pick", ("robot", "bun"))
    assert told(pick)[0].imagine(call, on, OBJECTS).unmet == MANY
    imagined = told(pick, untested=[cookable])[0].imagine(call, on, OBJECTS)
    assert imagined.unmet == len(imagined.doubts) == 1
    assert imagined.facts == {fact("full", "robot")}


def test_other_words_are_passed_over() -> None:
    assert told_rules(["(none)", "- Pick works if you are lucky.", "  needs luck"]) == ()

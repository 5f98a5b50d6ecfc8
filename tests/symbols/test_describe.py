from __future__ import annotations

from skillwrapper.domains.burger.expert import expert_model
from skillwrapper.symbols import ConditionalEffect, Literal, Operator, Variable
from skillwrapper.symbols.describe import describe_model, describe_operator, describe_predicate
from skillwrapper.symbols.predicates import Atom, Predicate


def test_operator_in_words() -> None:
    (operator,) = (o for o in expert_model().operators if o.name == "Pick_from_ingredient")
    assert describe_operator(operator) == (
        "Pick_from_ingredient: Pick(?robot: robot, ?item: pickupable) with ?base: pickupable\n"
        "  needs hand_empty(?robot), nothing_on(?item), stacked_on(?item, ?base)\n"
        "  makes true holding(?robot, ?item), nothing_on(?base)\n"
        "  makes false hand_empty(?robot), stacked_on(?item, ?base)"
    )


def test_what_is_untested_is_set_apart() -> None:
    (operator,) = (o for o in expert_model().operators if o.name == "Pick_from_table")
    item = operator.parameters[1]
    absence = min(operator.absences)
    text = describe_operator(operator, {absence, item})
    assert f"\n  may need {absence}\n  may need ?item: pickupable\n" in text
    assert text.count(str(absence)) == 1
    assert "\n  needs hand_empty(?robot), " in text


def test_absence_and_conditional_effect_in_words() -> None:
    other = Variable("?other", ("item",))
    effect = ConditionalEffect(
        other, (Literal(Atom("on", ("?other", "?a"))),), Literal(Atom("hot", ("?other",)))
    )
    heat = Operator(
        "Heat",
        "Heat",
        (Variable("?a", ("item",)),),
        1,
        frozenset(),
        frozenset(),
        frozenset(),
        frozenset(),
        frozenset({effect}),
    )
    assert describe_operator(heat) == (
        "Heat: Heat(?a: item)\n  changes every other ?other with on(?other, ?a): hot(?other)"
    )
    (table,) = (o for o in expert_model().operators if o.name == "Pick_from_table")
    assert "  needs no other ?other: on_station(?item, ?other)" in describe_operator(table)


def test_empty_operator_and_whole_model() -> None:
    nothing = Operator("W", "W", (), 0, frozenset(), frozenset(), frozenset(), frozenset())
    assert describe_operator(nothing) == "W: W()\n  needs and changes nothing"
    text = describe_model(expert_model())
    assert text.startswith("hand_empty(?robot): The robot holds nothing.\n")
    assert text.count("\n\n") == 7


def test_predicate_without_semantics() -> None:
    assert describe_predicate(Predicate("wet", ("item",))) == "wet(?item)"

"""The worked example of the paper's appendix on operator learning.

Two misprints there are mended: the second transition takes the apple off the table, not the bottle,
and what is held after the third is the object.
"""

from __future__ import annotations

from skillwrapper.learning.learner import learn_operators
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Atom, Literal, Operator, Predicate
from skillwrapper.transitions.entries import label_entries
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Parameter, Skill
from skillwrapper.world.types import Object, TypeHierarchy

DOMAIN = Domain(
    name="table",
    agent="",
    description="",
    types=TypeHierarchy({"robot": (), "table": (), "object": (), "openable": ()}),
    objects=(
        Object("Robot", ("robot",)),
        Object("Table", ("table",)),
        Object("Bottle", ("object", "openable")),
        Object("Apple", ("object",)),
        Object("Banana", ("object",)),
    ),
    skills=(Skill("PickUp", (Parameter("robot", "robot"), Parameter("object", "object"))),),
)
VOCABULARY = (
    Predicate("is_on", ("object", "table")),
    Predicate("hand_free", ("robot",)),
    Predicate("is_holding", ("robot", "object")),
)
FREE, BANANA = "hand_free(Robot)", "is_on(Banana, Table)"


def _pick(thing: str, before: list[str]) -> dict[str, object]:
    return {
        "skill": "PickUp",
        "arguments": ["Robot", thing],
        "success": True,
        "before": [*before, FREE, BANANA],
        "after": [f"is_holding(Robot, {thing})", BANANA],
    }


def test_two_operators_for_one_skill() -> None:
    entries = [
        _pick("Bottle", ["is_on(Bottle, Table)"]),
        _pick("Apple", ["is_on(Apple, Table)"]),
        _pick("Bottle", []),
    ]
    settings = LearnerSettings(absences=False, existential_context=0)
    fit = learn_operators(label_entries(DOMAIN, entries, VOCABULARY), settings=settings)
    off_the_table, out_of_the_air = sorted(
        fit.model.operators, key=lambda o: len(o.parameters), reverse=True
    )

    def literals(operator: Operator) -> tuple[Literal, ...]:
        robot, thing = (v.name for v in operator.parameters[:2])
        holding = Literal(Atom("is_holding", (robot, thing)), False)
        return holding, Literal(Atom("hand_free", (robot,)), True)

    robot, thing, table = (v.name for v in off_the_table.parameters)
    on_table = Atom("is_on", (thing, table))
    assert off_the_table.preconditions == {*literals(off_the_table), Literal(on_table, True)}
    assert off_the_table.add_effects == {Atom("is_holding", (robot, thing))}
    assert off_the_table.delete_effects == {on_table, Atom("hand_free", (robot,))}

    robot, thing = (v.name for v in out_of_the_air.parameters)
    assert out_of_the_air.preconditions == set(literals(out_of_the_air))
    assert out_of_the_air.add_effects == {Atom("is_holding", (robot, thing))}
    assert out_of_the_air.delete_effects == {Atom("hand_free", (robot,))}

"""D5: changes that range over a set of objects become conditional effects."""

from __future__ import annotations

import itertools

import numpy as np
from notebook import Notebook, atom, instance, make_domain

from skillwrapper.grounding import GroundModel
from skillwrapper.learning.certification import certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.symbols import ConditionalEffect, Literal, Predicate, Variable

CANTEEN = make_domain(
    types={"robot": (), "thing": (), "tray": ("thing",), "cup": ("thing",), "room": ()},
    objects={
        "r": "robot",
        "tray": "tray",
        "c1": "cup",
        "c2": "cup",
        "c3": "cup",
        "hall": "room",
        "bar": "room",
    },
    skills={"Carry": "robot tray room", "Empty": "robot tray"},
    failures_change_nothing=True,
)
ON = Predicate("on", ("cup", "tray"))
AT = Predicate("at", ("thing", "room"))
FIXED = Predicate("fixed", ("tray",))
CUPS = ("c1", "c2", "c3")
EACH = Variable("?each", ("thing",))  # nothing on the tray shows that only cups go along


def carry(notebook: Notebook, loaded: tuple[str, ...], *, success: bool = True) -> None:
    """Carry the tray to the bar; what is loaded goes with it, the rest stays in the hall."""
    on = " ".join(f"on({c}, tray)" for c in loaded)
    rest = " ".join(f"at({c}, hall)" for c in CUPS if c not in loaded)
    before = f"{on} {rest} at(tray, hall) " + " ".join(f"at({c}, hall)" for c in loaded)
    after = f"{on} {rest} at(tray, bar) " + " ".join(f"at({c}, bar)" for c in loaded)
    if success:
        notebook.success(before, "Carry(r, tray, bar)", after)
    else:
        notebook.failure(before, "Carry(r, tray, bar)")


def loads(least: int) -> list[tuple[str, ...]]:
    return [c for n in range(least, 4) for c in itertools.combinations(CUPS, n)]


def successor(fit: Fit, state: str, skill: str) -> set[str]:
    """The atoms that are true after a skill, which every operator must agree on."""
    model = GroundModel.of(fit.model, CANTEEN.objects)
    true = {a for a in model.space.atoms if str(a) in state}
    row = np.array([a in true for a in model.space.atoms], dtype=np.int8)
    (following,) = model.successors(row[np.newaxis], instance(skill))
    return set(map(str, model.space.true_atoms(following)))


def test_a_tray_takes_along_what_lies_on_it() -> None:
    notebook = Notebook(CANTEEN, ON, AT)
    for loaded in loads(least=0):
        carry(notebook, loaded)
    (learned,) = notebook.fit_skill("Carry").operators
    condition = (Literal(atom("on(?each, ?tray_1)")),)  # where the cup is follows from it
    assert learned.operator.conditional_effects == {
        ConditionalEffect(EACH, condition, Literal(atom("at(?each, ?room_2)"))),
        ConditionalEffect(EACH, condition, Literal(atom("at(?each, ?other_room)"), False)),
    }
    assert learned.operator.add_effects == {atom("at(?tray_1, ?room_2)")}
    assert learned.operator.delete_effects == {atom("at(?tray_1, ?other_room)")}
    fit = notebook.fit(ON, AT)
    assert not fit.inconsistencies
    assert not certify(fit).violations


def test_a_tray_that_was_never_empty() -> None:
    """The cup that always lies on it is a parameter, and goes along like every other."""
    notebook = Notebook(CANTEEN, ON, AT)
    for loaded in loads(least=1):
        carry(notebook, loaded)
    fit = notebook.fit_skill("Carry")
    (learned,) = fit.operators
    assert [v.types for v in learned.operator.context] == [("room",), ("cup",)]
    assert not fit.inconsistencies
    state = "on(c1, tray) on(c2, tray) at(c1, hall) at(c2, hall) at(c3, hall) at(tray, hall)"
    assert {"at(c1, bar)", "at(c2, bar)", "at(tray, bar)"} < successor(
        notebook.fit(), state, "Carry(r, tray, bar)"
    )


def test_failures_are_not_taken_for_successes_of_an_empty_tray() -> None:
    """All of the change is conditional; what is left of it is nothing, like a failure's."""
    notebook = Notebook(CANTEEN, ON, FIXED)
    for loaded in loads(least=1):
        on = " ".join(f"on({c}, tray)" for c in loaded)
        notebook.success(on, "Empty(r, tray)", "")
        notebook.failure(f"{on} fixed(tray)", "Empty(r, tray)")
    notebook.failure("fixed(tray)", "Empty(r, tray)")
    fit = notebook.fit()
    (learned,) = fit.operators
    assert len(learned.operator.conditional_effects) == 1
    assert not fit.inconsistencies
    assert not certify(fit).violations


def test_one_operator_that_is_wrong_does_not_replace_several_that_are_right() -> None:
    """Failures with more than two cups: one operator for all loads would apply to them."""
    notebook = Notebook(CANTEEN, ON, AT)
    for loaded in loads(least=0):
        if len(loaded) < 3:
            carry(notebook, loaded)
    carry(notebook, CUPS, success=False)
    fit = notebook.fit_skill("Carry")
    assert len(fit.operators) == 3
    assert not fit.inconsistencies


def test_a_change_of_some_of_them_is_no_rule() -> None:
    """Of three cups on the tray two fall off, and nothing tells which."""
    notebook = Notebook(CANTEEN, ON)
    everything = " ".join(f"on({c}, tray)" for c in CUPS)
    for left in CUPS:
        notebook.success(everything, "Empty(r, tray)", f"on({left}, tray)")
    assert all(not o.operator.conditional_effects for o in notebook.fit().operators)


def test_unknown_labels_are_no_counterexample() -> None:
    notebook = Notebook(CANTEEN, ON)
    notebook.success("on(c1, tray) on(c2, tray)", "Empty(r, tray)", "")
    notebook.success("on(c1, tray) on(c2, tray) on(c3, tray)", "Empty(r, tray)", "")
    notebook.success("on(c1, tray) on(c2, tray)", "Empty(r, tray)", "?on(c1, tray)")
    (learned,) = notebook.fit().operators
    assert len(learned.operator.conditional_effects) == 1


def test_a_scene_in_which_nothing_can_be_said_is_no_counterexample() -> None:
    notebook = Notebook(CANTEEN, ON)
    notebook.success("on(c1, tray) on(c2, tray)", "Empty(r, tray)", "")
    notebook.episode(("", "Empty(r, tray)", True, "#2"), scene=["r", "tray"])
    (learned,) = notebook.fit_skill("Empty").operators
    assert len(learned.operator.conditional_effects) == 1


def test_what_happens_to_all_of_them_needs_no_relation_among_the_changes() -> None:
    """Whatever is on the tray becomes clean; only the condition connects it to the tray."""
    clean = Predicate("clean", ("cup",))
    notebook = Notebook(CANTEEN, ON, clean)
    for loaded in loads(least=1):
        on = " ".join(f"on({c}, tray)" for c in loaded)
        done = " ".join(f"clean({c})" for c in loaded)
        notebook.success(on, "Empty(r, tray)", f"{on} {done}")
    (learned,) = notebook.fit().operators
    assert [e.effect for e in learned.operator.conditional_effects] == [
        Literal(atom("clean(?each)"))
    ]
    assert not notebook.fit().inconsistencies
    assert not certify(notebook.fit()).violations


def test_what_is_in_a_machine_is_changed_and_stays_in_it() -> None:
    """Nothing of the argument changes, and the relation neither."""
    domain = make_domain(
        types={"washer": (), "shirt": ()},
        objects={"w": "washer", "a": "shirt", "b": "shirt"},
        skills={"Wash": "washer"},
    )
    inside, clean = Predicate("inside", ("shirt", "washer")), Predicate("clean", ("shirt",))
    notebook = Notebook(domain, inside, clean)
    notebook.success("inside(a, w)", "Wash(w)", "inside(a, w) clean(a)")
    notebook.success("inside(b, w) clean(a)", "Wash(w)", "inside(b, w) clean(a) clean(b)")
    notebook.success("", "Wash(w)", "#2")
    fit = notebook.fit_skill("Wash")
    effects = {str(e) for o in fit.operators for e in o.operator.conditional_effects}
    assert any("inside(?each, ?washer_0)" in effect for effect in effects)
    assert fit.inconsistencies == ()


def test_what_is_so_already_tells_nothing_of_what_would_come_about() -> None:
    """A wet shirt stays wet in the washer: that does not mean that only stained ones get wet."""
    domain = make_domain(
        types={"washer": (), "shirt": ()},
        objects={"w": "washer", "a": "shirt", "b": "shirt"},
        skills={"Wash": "washer"},
    )
    inside, clean = Predicate("inside", ("shirt", "washer")), Predicate("clean", ("shirt",))
    wet = Predicate("wet", ("shirt",))
    notebook = Notebook(domain, inside, clean, wet)
    notebook.success("inside(a, w)", "Wash(w)", "inside(a, w) clean(a) wet(a)")
    notebook.success(
        "inside(a, w) inside(b, w) clean(a) wet(a)", "Wash(w)",
        "inside(a, w) inside(b, w) clean(a) clean(b) wet(a) wet(b)",
    )  # fmt: skip
    fit = notebook.fit(inside, clean, wet)
    (learned,) = fit.operators
    tied = (Literal(atom("inside(?each, ?washer_0)")),)
    assert {e.condition for e in learned.operator.conditional_effects} == {tied}
    assert fit.inconsistencies == ()
    assert not certify(fit).violations


def test_a_relation_that_reaches_on_to_what_is_below() -> None:
    """Nothing or one thing below is enough to see it: two operators would say the same."""
    stacks = make_domain(
        types={"block": ()},
        objects={"a": "block", "b": "block", "c": "block", "d": "block"},
        skills={"Stack": "block block"},
        failures_change_nothing=True,
    )
    notebook = Notebook(stacks, above := Predicate("above", ("block", "block")))
    notebook.success("", "Stack(a, b)", "above(a, b)")
    notebook.success("above(c, d)", "Stack(a, b)", "above(c, d) above(a, b)")
    notebook.success("above(b, c)", "Stack(a, b)", "above(b, c) above(a, b) above(a, c)")
    notebook.success("above(b, d)", "Stack(c, b)", "above(b, d) above(c, b) above(c, d)")
    (learned,) = notebook.fit_skill("Stack").operators
    (effect,) = learned.operator.conditional_effects
    assert effect.effect == Literal(atom("above(?block_0, ?each)"))
    assert effect.condition == (Literal(atom("above(?block_1, ?each)")),)
    assert not notebook.fit(above).inconsistencies


def test_a_relation_of_one_case_alone_does_not_range() -> None:
    """Always one thing below: it is a parameter like every other."""
    stacks = make_domain(
        types={"block": ()},
        objects={"a": "block", "b": "block", "c": "block", "d": "block"},
        skills={"Stack": "block block"},
        failures_change_nothing=True,
    )
    notebook = Notebook(stacks, Predicate("above", ("block", "block")))
    notebook.success("above(b, c)", "Stack(a, b)", "above(b, c) above(a, b) above(a, c)")
    notebook.success("above(b, d)", "Stack(c, b)", "above(b, d) above(c, b) above(c, d)")
    (learned,) = notebook.fit_skill("Stack").operators
    assert not learned.operator.conditional_effects

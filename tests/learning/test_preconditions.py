"""Preconditions: plain literals, universal absence and existential context (D2, D4, D10)."""

from __future__ import annotations

from notebook import Notebook, atom, make_domain

from skillwrapper.symbols import Absence, Literal, Operator, Predicate, Variable

WORKSHOP = make_domain(
    types={
        "robot": (),
        "item": (),
        "tool": ("item",),
        "place": (),
        "bench": ("place",),
    },
    objects={
        "r": "robot",
        "a": "item",
        "b": "item",
        "t": "tool",
        "x": "bench",
        "y": "bench",
        "z": "place",
    },
    skills={"Fix": "robot item", "Rest": "robot"},
)
IDLE = Predicate("idle", ("robot",))
NIGHT = Predicate("night", ())
DONE = Predicate("done", ("item",))
ON = Predicate("on", ("item", "place"))
UPON = Predicate("upon", ("item", "item"))
LIT = Predicate("lit", ("place",))
NEAR = Predicate("near", ("robot", "place"))
NEXT = Predicate("next", ("item", "place"))


def only_operator(notebook: Notebook, skill: str = "Fix") -> Operator:
    (learned,) = notebook.fit_skill(skill).operators
    return learned.operator


def literals(*texts: str) -> set[Literal]:
    return {Literal(atom(t.removeprefix("not ")), not t.startswith("not ")) for t in texts}


def test_what_always_held_is_required() -> None:
    notebook = Notebook(WORKSHOP, IDLE, DONE, NIGHT)
    notebook.success("idle(r) night()", "Fix(r, a)", "idle(r) night() done(a)")
    notebook.success("idle(r)", "Fix(r, b)", "idle(r) done(b)")
    operator = only_operator(notebook)
    assert operator.preconditions == literals("idle(?robot_0)", "not done(?item_1)")
    assert operator.add_effects == {atom("done(?item_1)")}
    assert not operator.delete_effects
    assert not operator.absences
    assert operator.context == ()


def test_nullary_literals_count() -> None:
    notebook = Notebook(WORKSHOP, NIGHT, DONE)
    notebook.success("", "Fix(r, a)", "done(a)")
    assert Literal(atom("night()"), False) in only_operator(notebook).preconditions


def test_a_literal_must_be_seen_once_and_never_contradicted() -> None:
    """D10: a lamp is no argument, so its unknown label does not hide what the skill did."""
    notebook = Notebook(WORKSHOP, DONE, ON, LIT)
    notebook.success("on(a, x) ?lit(y)", "Fix(r, a)", "on(a, x) done(a) ?lit(y)")
    notebook.success("on(b, x) lit(y)", "Fix(r, b)", "on(b, x) done(b) lit(y)")
    assert not {p for p in only_operator(notebook).preconditions if p.atom.predicate == "lit"}


def test_never_seen_is_not_required() -> None:
    notebook = Notebook(WORKSHOP, IDLE, DONE)
    notebook.success("?idle(r)", "Fix(r, a)", "?idle(r) done(a)")
    assert notebook.fit_skill("Fix").operators == ()


def test_negative_literals_need_the_right_types() -> None:
    """``upon`` of a place says nothing: no grounding, no literal."""
    notebook = Notebook(WORKSHOP, DONE, UPON)
    notebook.success("", "Fix(r, a)", "done(a)")
    operator = only_operator(notebook)
    assert operator.preconditions == literals("not done(?item_1)")
    assert {a.atom for a in operator.absences} == {
        atom("upon(?any, ?item_1)"),
        atom("upon(?item_1, ?any)"),
    }


def test_universal_absence() -> None:
    """Nothing lies on the item; that something lies elsewhere does not matter."""
    notebook = Notebook(WORKSHOP, DONE, UPON)
    notebook.success("upon(a, t)", "Fix(r, a)", "upon(a, t) done(a)")
    notebook.success("upon(a, t)", "Fix(r, b)", "upon(a, t) done(b)")
    operator = only_operator(notebook)
    assert operator.absences == {Absence(atom("upon(?any, ?item_1)"), ("?any",))}


def test_absence_must_have_been_possible() -> None:
    """In a scene without another item, ``upon`` says nothing of the item."""
    notebook = Notebook(WORKSHOP, DONE, UPON)
    step = ("", "Fix(r, a)", True, "done(a)")
    notebook.episode(step, scene=("r", "a", "x"))
    assert not only_operator(notebook).absences


def test_absence_and_presence_together_are_nothing() -> None:
    notebook = Notebook(WORKSHOP, DONE, UPON)
    notebook.success("", "Fix(r, a)", "done(a)")
    notebook.success("upon(t, b) upon(b, a)", "Fix(r, b)", "upon(t, b) upon(b, a) done(b)")
    operator = only_operator(notebook)
    assert not operator.absences
    assert operator.context == ()


def test_existential_context_with_the_most_specific_type() -> None:
    """It always lies on some bench, another one each time."""
    notebook = Notebook(WORKSHOP, DONE, ON)
    notebook.success("on(a, x) on(b, z)", "Fix(r, a)", "on(a, x) on(b, z) done(a)")
    notebook.success("on(a, y)", "Fix(r, a)", "on(a, y) done(a)")
    operator = only_operator(notebook)
    assert operator.context == (Variable("?other_bench", ("bench",)),)
    assert literals("on(?item_1, ?other_bench)") < operator.preconditions


def test_two_patterns_may_share_a_witness() -> None:
    """The robot is always near the place where the item lies: one place, not two."""
    notebook = Notebook(WORKSHOP, DONE, ON, NEAR)
    for place in "xz":
        state = f"on(a, {place}) near(r, {place})"
        notebook.success(state, "Fix(r, a)", f"{state} done(a)")
    operator = only_operator(notebook)
    assert operator.context == (Variable("?other_place", ("place",)),)
    assert operator.preconditions == literals(
        "on(?item_1, ?other_place)", "near(?robot_0, ?other_place)", "not done(?item_1)"
    )


def test_two_patterns_without_a_common_witness_are_two_objects() -> None:
    notebook = Notebook(WORKSHOP, DONE, ON, NEAR)
    for here, there in ("xy", "zx"):
        state = f"on(a, {here}) near(r, {there})"
        notebook.success(state, "Fix(r, a)", f"{state} done(a)")
    operator = only_operator(notebook)
    assert operator.context == (
        Variable("?other_place", ("place",)),
        Variable("?other_bench", ("bench",)),
    )


def test_each_context_has_an_object_of_its_own_in_every_transition() -> None:
    """Else the operator would not apply where it was learned (D4).

    Three relations; in the second transition ``on`` could be met by two places, but sharing one
    with ``next`` leaves only that one, which ``near`` needs.
    """
    notebook = Notebook(WORKSHOP, DONE, ON, NEAR, NEXT)
    for state in ("on(a, x) near(r, y) next(a, x)", "on(a, x) on(a, y) near(r, x) next(a, x)"):
        notebook.success(state, "Fix(r, a)", f"{state} done(a)")
    fit = notebook.fit_skill("Fix")
    assert fit.predictions[0].executable.tolist() == [1, 1]


def test_types_of_contexts_leave_each_an_object_of_its_own() -> None:
    """``on`` is always met by a bench, but the only bench is once needed for ``near``."""
    notebook = Notebook(WORKSHOP, DONE, ON, NEAR)
    for state in ("on(a, x) near(r, z)", "on(a, x) on(a, z) near(r, x)"):
        notebook.success(state, "Fix(r, a)", f"{state} done(a)")
    fit = notebook.fit_skill("Fix")
    assert fit.operators[0].operator.context == (
        Variable("?other_place", ("place",)),
        Variable("?other_place_2", ("place",)),
    )
    assert fit.predictions[0].executable.tolist() == [1, 1]


def test_a_pattern_that_needs_the_object_of_another_is_left_out() -> None:
    """Once a single place is both, once there are two: neither shared nor separate."""
    notebook = Notebook(WORKSHOP, DONE, ON, NEAR)
    for state in ("on(a, x) near(r, x)", "on(a, x) near(r, y)"):
        notebook.success(state, "Fix(r, a)", f"{state} done(a)")
    fit = notebook.fit_skill("Fix")
    assert len(fit.operators[0].operator.context) == 1
    assert fit.predictions[0].executable.tolist() == [1, 1]


def test_effect_context_is_described_by_what_it_alone_was() -> None:
    """A literal speaks of an argument or of one context object alone (paper, Section 3.3)."""
    taken = Predicate("taken", ("robot", "item"))
    notebook = Notebook(WORKSHOP, taken, ON, LIT, UPON)
    for here, item in ("xa", "yb"):
        notebook.success(
            f"on({item}, {here}) lit({here}) upon({item}, t)",
            f"Fix(r, {item})",
            f"taken(r, {item}) lit({here})",
        )
    operator = only_operator(notebook)
    assert operator.context == (
        Variable("?other_bench", ("bench",)),
        Variable("?other_tool", ("tool",)),
    )
    assert (
        literals("lit(?other_bench)", "not taken(?robot_0, ?other_tool)") < operator.preconditions
    )
    assert Literal(atom("on(?other_tool, ?other_bench)"), False) not in operator.preconditions
    assert operator.delete_effects == {
        atom("on(?item_1, ?other_bench)"),
        atom("upon(?item_1, ?other_tool)"),
    }

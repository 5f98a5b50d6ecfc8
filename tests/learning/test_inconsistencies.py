"""The four kinds of inconsistency: the smallest example of each, and one without it."""

from __future__ import annotations

from notebook import Notebook, atom, make_domain

from skillwrapper.learning.inconsistencies import Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate

KITCHEN = make_domain(
    types={"robot": (), "item": (), "place": ()},
    objects={"r": "robot", "a": "item", "b": "item", "c": "item", "x": "place", "y": "place"},
    skills={"Take": "robot item"},
)
EMPTY = Predicate("empty", ("robot",))
HELD = Predicate("held", ("item",))
ON = Predicate("on", ("item", "place"))
FREE = Predicate("free", ("place",))
UPON = Predicate("upon", ("item", "item"))


def kinds(notebook: Notebook) -> list[str]:
    return [str(i.kind) for i in notebook.fit_skill("Take").inconsistencies]


def only(notebook: Notebook) -> Inconsistency:
    (found,) = notebook.fit_skill("Take").inconsistencies
    return found


def test_nothing_recorded_nothing_inconsistent() -> None:
    assert kinds(Notebook(KITCHEN, HELD)) == []


def test_successes_alone_are_consistent() -> None:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    assert kinds(notebook) == []


def test_precondition() -> None:
    """Condition 1: the vocabulary sees the change, but not why it did not come about."""
    notebook = Notebook(KITCHEN, HELD)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.failure("#hand is full", "Take(r, a)")
    found = only(notebook)
    assert found.kind is InconsistencyKind.PRECONDITION
    assert (found.first, found.second, found.culprit) == (0, 1, 1)


def test_precondition_resolved() -> None:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.failure("", "Take(r, a)")
    assert kinds(notebook) == []


def test_precondition_may_hang_on_a_context_object() -> None:
    notebook = Notebook(KITCHEN, UPON, HELD)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.failure("upon(b, a)", "Take(r, a)")
    assert kinds(notebook) == []


def test_effect() -> None:
    """Condition 2: the vocabulary sees why it failed, but not what success changes."""
    notebook = Notebook(KITCHEN, EMPTY)
    notebook.success("empty(r) #1", "Take(r, a)", "empty(r) #2")
    notebook.failure("", "Take(r, b)")
    found = only(notebook)
    assert found.kind is InconsistencyKind.EFFECT
    assert (found.first, found.second, found.culprit) == (0, 1, 1)


def test_effect_of_a_failure_that_changed_something() -> None:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "empty(r) held(a)")
    notebook.failure("", "Take(r, b)", "held(b)")
    assert kinds(notebook) == ["effect"]


def test_effect_resolved() -> None:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "empty(r) held(a)")
    notebook.failure("", "Take(r, b)")
    assert kinds(notebook) == []


def test_effect_does_not_ask_for_a_change_that_was_none() -> None:
    """D7: by the robot's word, or because other successes of the skill tell their change.

    Pictures differ all the time: seen from another place, one repeated Cook of the real Robotouille
    once destroyed ``is_cooked`` for a whole run.
    """
    known = Notebook(KITCHEN, EMPTY)
    known.success("empty(r) #1", "Take(r, a)", "empty(r) #2", changed=False)
    known.failure("", "Take(r, b)")
    assert kinds(known) == []
    repeated = Notebook(KITCHEN, EMPTY, HELD)
    repeated.success("empty(r)", "Take(r, a)", "empty(r) held(a)")
    repeated.success("held(a) #1", "Take(r, a)", "held(a) #2")
    repeated.failure("", "Take(r, b)")
    assert kinds(repeated) == []


def test_bootstrapping() -> None:
    """D7: without a predicate conditions 1 and 2 both hold of every failure."""
    notebook = Notebook(KITCHEN)
    notebook.success("#1", "Take(r, a)", "#2")
    notebook.failure("#2", "Take(r, a)")
    (learned,) = notebook.fit_skill("Take").operators
    assert not learned.operator.preconditions
    assert not learned.operator.add_effects
    assert kinds(notebook) == ["precondition", "effect"]


def test_a_skill_that_never_succeeded_has_no_operator() -> None:
    notebook = Notebook(KITCHEN)
    notebook.failure("#1", "Take(r, a)")
    assert notebook.fit_skill("Take").operators == ()
    assert kinds(notebook) == []


def test_determinism() -> None:
    """D5: taken from a stack, it once left the item below and once kept sticking to it."""
    notebook = Notebook(KITCHEN, HELD, UPON)
    notebook.success("upon(a, b)", "Take(r, a)", "held(a)")
    notebook.success("upon(b, c)", "Take(r, b)", "upon(b, c) held(b)")
    first, second = notebook.fit_skill("Take").inconsistencies
    assert first.kind is second.kind is InconsistencyKind.DETERMINISM
    assert (first.first, first.second, first.culprit) == (0, 1, 0)
    assert (second.first, second.second, second.culprit) == (1, 0, 1)


def test_a_more_general_operator_must_not_apply_to_another_change() -> None:
    """The paper is content that *some* applicable operator is right."""
    notebook = Notebook(KITCHEN, HELD, UPON, EMPTY)
    notebook.success("upon(a, b)", "Take(r, a)", "held(a)")
    notebook.success("upon(a, b) empty(r)", "Take(r, a)", "upon(a, b) empty(r) held(a)")
    notebook.success("", "Take(r, a)", "held(a)")
    assert kinds(notebook) == ["determinism"]
    assert only(notebook).culprit == 0


def test_determinism_resolved() -> None:
    notebook = Notebook(KITCHEN, HELD, UPON)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.success("upon(a, b)", "Take(r, a)", "held(a)")
    assert kinds(notebook) == []


def test_unexplained() -> None:
    """D1: the place became free, and nothing says what it has to do with the item."""
    notebook = Notebook(KITCHEN, HELD, FREE)
    notebook.success("", "Take(r, a)", "held(a) free(x)")
    found = only(notebook)
    assert found.kind is InconsistencyKind.UNEXPLAINED
    assert (found.first, found.second, found.culprit) == (0, None, 0)
    assert found.unexplained == (atom("free(x)"),)


def test_unexplained_resolved() -> None:
    notebook = Notebook(KITCHEN, HELD, FREE, ON)
    notebook.success("on(a, x)", "Take(r, a)", "held(a) free(x)")
    assert kinds(notebook) == []


def test_failures_need_no_explanation() -> None:
    notebook = Notebook(KITCHEN, HELD, FREE)
    notebook.failure("", "Take(r, a)", "free(x)")
    assert kinds(notebook) == []


def test_no_kind_rests_on_an_unknown_label() -> None:
    """D10: the examples above, with the label in question unknown."""
    notebook = Notebook(KITCHEN, HELD, EMPTY)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.failure("?empty(r)", "Take(r, a)")
    notebook.failure("empty(r)", "Take(r, b)", "empty(r) ?held(b)")
    assert kinds(notebook) == ["precondition"]
    assert only(notebook).culprit == 2

    notebook = Notebook(KITCHEN, HELD, FREE)
    notebook.success("", "Take(r, a)", "held(a) ?free(x)")
    assert kinds(notebook) == []

    notebook = Notebook(KITCHEN, HELD, UPON)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.success("upon(b, a)", "Take(r, a)", "upon(b, a) held(a) ?upon(a, c)")
    assert kinds(notebook) == []


def test_pairs_of_one_cause_count_once() -> None:
    """D8: identified by the lifted state; each failure is still a witness of its own."""
    notebook = Notebook(KITCHEN, HELD, EMPTY)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.success("empty(r)", "Take(r, b)", "empty(r) held(b)")
    for number in range(3):
        notebook.failure(f"#{number}", "Take(r, c)")
        notebook.failure(f"empty(r) #{number}", "Take(r, c)")
    fit = notebook.fit_skill("Take")
    assert len(fit.inconsistencies) == 6
    assert len({i.witness for i in fit.inconsistencies}) == 6
    assert [i.culprit for i in distinct_causes(fit.inconsistencies)] == [2, 3]


def test_the_pair_that_differs_least() -> None:
    """D8: same arguments first, then close in time."""
    notebook = Notebook(KITCHEN, HELD)
    notebook.success("#1", "Take(r, a)", "held(a)")
    notebook.success("#2", "Take(r, b)", "held(b)")
    notebook.failure("#3", "Take(r, a)")
    notebook.success("#4", "Take(r, b)", "held(b)")
    notebook.failure("#5", "Take(r, c)")
    first, second = notebook.fit_skill("Take").inconsistencies
    assert (first.first, first.second) == (0, 2)
    assert (second.first, second.second) == (3, 4)

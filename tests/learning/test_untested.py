"""Conditions that nothing has put to the test."""

from __future__ import annotations

import pytest
from barn import AT, BARN, EMPTY_HAND, FULL, NOT_HELD, NOTHING_ATOP, ON_NOTHING, barn
from notebook import Notebook

from skillwrapper.learning.untested import find_untested
from skillwrapper.symbols import Variable


def untested(notebook: Notebook, operator: str = "Lift_1") -> frozenset[object]:
    return frozenset(find_untested(notebook.fit())[operator])


def test_without_a_failure_nothing_is_tested() -> None:
    notebook = barn()
    notebook.failure("on(b, f) on(f, b)", "Lift(h, f)")  # else on would tell nothing
    assert untested(notebook) == {EMPTY_HAND, NOT_HELD, NOTHING_ATOP, ON_NOTHING}


@pytest.mark.parametrize(
    ("state", "condition"), [("full(h)", EMPTY_HAND), ("on(b, a)", NOTHING_ATOP)]
)
def test_a_failure_where_one_condition_alone_is_unmet_tests_it(
    state: str, condition: object
) -> None:
    left = untested(barn(state, "on(b, f) on(f, b) full(h)"))
    assert condition not in left
    assert NOT_HELD in left


def test_a_failure_with_two_unmet_conditions_tests_neither() -> None:
    left = untested(barn("full(h) on(b, a)", "held(a) on(a, b)"))
    assert left == {EMPTY_HAND, NOT_HELD, NOTHING_ATOP, ON_NOTHING}


def test_an_unknown_label_tests_nothing() -> None:
    vague = barn("full(h) ?on(b, a)", "on(b, f) on(f, b)")
    assert EMPTY_HAND in untested(vague)
    assert EMPTY_HAND in untested(barn("full(h) held(a)", "?full(h)"))


def test_a_success_that_changed_otherwise_is_a_test_too() -> None:
    """Another operator tells it apart by this condition alone."""
    notebook = barn("full(h)", "on(b, a)")
    notebook.success("on(a, b)", "Lift(h, a)", "full(h) held(a)")
    assert untested(notebook, "Lift_2") == {NOT_HELD}
    assert ON_NOTHING in untested(notebook, "Lift_1")  # nothing was ever on two things


def test_types_that_were_never_left_are_untested() -> None:
    """Beyond what the skill asks for (D3)."""
    frail = Variable("?crate_1", ("frail",))
    assert frail in untested(barn("full(h)", crates="f"))
    assert not any(isinstance(c, Variable) for c in untested(barn("full(h)", crates="fa")))
    failed = barn("full(h)", crates="f")
    failed.failure("", "Lift(h, a)")
    assert frail not in untested(failed)


def test_types_that_a_relation_asks_for_are_no_condition_of_their_own() -> None:
    def lifted_from(*shelves: str) -> Notebook:
        notebook = Notebook(BARN, FULL, AT)
        for shelf in shelves:
            notebook.success(f"at(a, {shelf})", "Lift(h, a)", "full(h)")
        notebook.failure("", "Lift(h, a)")
        return notebook

    assert Variable("?other_low", ("low",)) in untested(lifted_from("l"))
    assert not any(isinstance(c, Variable) for c in untested(lifted_from("l", "s")))

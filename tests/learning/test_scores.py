"""Scores of candidates (D6): both outcomes count, undecided transitions do not."""

from __future__ import annotations

import pytest
from notebook import Notebook, make_domain

from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate

KITCHEN = make_domain(
    types={"robot": (), "item": (), "place": ()},
    objects={"r": "robot", "a": "item", "b": "item", "x": "place"},
    skills={"Take": "robot item"},
)
EMPTY = Predicate("empty", ("robot",))
HELD = Predicate("held", ("item",))
FREE = Predicate("free", ("place",))


def scores(notebook: Notebook) -> tuple[float | None, float | None]:
    """Executability, effects."""
    fit = notebook.fit_skill("Take")
    return fit.score(InconsistencyKind.PRECONDITION), fit.score(InconsistencyKind.EFFECT)


def test_correctly_predicted_failures_count() -> None:
    """The paper's Algorithm 5 counts successes only and would give 1/4 for both."""
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    for number in range(3):
        notebook.failure(f"#{number}", "Take(r, a)")
    assert scores(notebook) == (1.0, 1.0)


def test_wrongly_predicted_transitions_do_not() -> None:
    notebook = Notebook(KITCHEN, HELD)
    notebook.success("", "Take(r, a)", "held(a)")
    for number in range(3):
        notebook.failure(f"#{number}", "Take(r, a)")
    assert scores(notebook) == (0.25, 1.0)

    notebook = Notebook(KITCHEN, EMPTY)
    notebook.success("empty(r) #1", "Take(r, a)", "empty(r) #2")
    for number in range(3):
        notebook.failure(f"#{number}", "Take(r, a)")
    assert scores(notebook) == (1.0, 0.25)


def test_unexplained_successes_do_not_count() -> None:
    notebook = Notebook(KITCHEN, HELD, FREE)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.success("", "Take(r, b)", "held(b) free(x)")
    assert scores(notebook) == (1.0, 0.5)


def test_undecided_transitions_do_not_count() -> None:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.failure("?empty(r)", "Take(r, a)")
    notebook.failure("empty(r)", "Take(r, b)")
    assert scores(notebook) == (0.5, 1.0)


def test_a_success_that_changes_nothing_visible_is_no_example_of_an_effect() -> None:
    """D7: else every failure would look like it and no candidate could pass."""
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.success("held(b) empty(r)", "Take(r, b)", "held(b) empty(r)")
    for number in range(3):
        notebook.failure(f"#{number}", "Take(r, a)")
    assert scores(notebook) == (1.0, 1.0)


def test_without_a_decided_transition_there_is_no_score() -> None:
    """D25: an undefined figure is undefined, never 1."""
    notebook = Notebook(KITCHEN, HELD)
    assert scores(notebook) == (None, None)
    notebook.failure("?held(a)", "Take(r, a)", "?held(a)")
    assert scores(notebook)[1] is None


@pytest.mark.parametrize("kind", list(InconsistencyKind))
def test_kinds_are_scored_by_executability_or_by_effects(kind: InconsistencyKind) -> None:
    notebook = Notebook(KITCHEN, HELD)
    notebook.success("", "Take(r, a)", "held(a)")
    notebook.failure("#1", "Take(r, a)")
    executability = kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.DETERMINISM)
    assert notebook.fit_skill("Take").score(kind) == (0.5 if executability else 1.0)

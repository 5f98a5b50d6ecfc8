"""D23: what one transition changed among many objects is no operator, and not hidden either."""

from __future__ import annotations

import pytest
from notebook import Notebook, make_domain

from skillwrapper.learning.certification import certify
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Predicate

BLOCKS = make_domain(
    types={"block": ()}, objects={f"b{n}": "block" for n in range(8)}, skills={"Lift": "block"}
)
ON, UP = Predicate("on", ("block", "block")), Predicate("up", ("block",))


def chain(length: int) -> str:
    return " ".join(f"on(b{n}, b{n + 1})" for n in range(length))


def fit(notebook: Notebook, most: int = 3) -> Fit:
    learner = FaithfulLearner(LearnerSettings(context_of_one=most))
    return learner.learn(notebook.fitter().labeller.label([ON, UP]))


def lifted(length: int, times: int = 1) -> Notebook:
    """Lifting took a chain of relations apart, beside a lift and a failure as they should be."""
    notebook = Notebook(BLOCKS, ON, UP)
    notebook.success("", "Lift(b7)", "up(b7)")
    notebook.failure("up(b7)", "Lift(b7)")
    for again in range(times):
        notebook.success(f"{chain(length)} #{again}", "Lift(b0)", "up(b0)")
    return notebook


@pytest.mark.parametrize(("length", "operators"), [(3, 2), (4, 1)])
def test_one_transition_brings_in_no_more_objects_than_allowed(length: int, operators: int) -> None:
    found = fit(lifted(length))
    assert len(found.operators) == operators
    assert len(fit(lifted(length), most=4).operators) == 2
    assert len(fit(lifted(length), most=2).operators) == 1


def test_what_is_seen_again_is_no_accident() -> None:
    assert len(fit(lifted(4, times=2)).operators) == 2


def test_what_is_left_out_is_listed_and_counts() -> None:
    """A vocabulary that needs many such changes must not look cheap."""
    without, with_it = fit(lifted(4)), fit(lifted(4), most=4)
    assert [len(c.ids) for c in without.skill("Lift").left_out] == [1]
    (violation,) = certify(without).violations
    assert (violation.transition, violation.reason) == (
        2,
        "no applicable operator makes the change",
    )
    assert without.cost == with_it.cost == 2 * LearnerSettings().operator_cost
    assert without.hard_cost == with_it.hard_cost


def test_a_change_that_ranges_over_a_set_is_learned_from_one_transition() -> None:
    """A conditional effect names no object, so the number of things on a tray does not matter."""
    tray = make_domain(
        types={"hand": (), "tray": (), "cup": ()},
        objects={"h": "hand", "t": "tray", **{f"c{n}": "cup" for n in range(5)}},
        skills={"Tip": "hand tray"},
    )
    on = Predicate("on", ("cup", "tray"))
    notebook = Notebook(tray, on)
    notebook.success(" ".join(f"on(c{n}, t)" for n in range(5)), "Tip(h, t)", "")
    found = FaithfulLearner().learn(notebook.fitter().labeller.label([on]))
    (learned,) = found.operators
    assert learned.operator.conditional_effects
    assert found.skill("Tip").left_out == ()
    assert certify(found).violations == ()


def test_one_transition_asks_for_no_more_objects_than_allowed() -> None:
    """Before a single transition everything in sight was always there.

    Eight relations with a witness each were eight parameters, and telling whether each can have
    an object of its own took the sets of all of them.
    """
    relations = tuple(Predicate(f"near_{n}", ("block", "block")) for n in range(7))
    notebook = Notebook(BLOCKS, UP, *relations)
    before = " ".join(f"near_{n}(b0, b{n + 1})" for n in range(7))
    notebook.success(before, "Lift(b0)", f"{before} up(b0)")
    notebook.failure("", "Lift(b0)")

    def most(**settings: int) -> int:
        learner = FaithfulLearner(LearnerSettings(**settings))
        found = learner.learn(notebook.fitter().labeller.label(notebook.predicates))
        return len(found.operators[0].operator.context)

    assert most() == 4
    assert most(existential_context=0) == 0
    assert most(existential_context=7) == 7

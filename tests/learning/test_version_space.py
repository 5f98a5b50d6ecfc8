"""Version spaces: what may be needed, what must be, and what a try would tell."""

from __future__ import annotations

import numpy as np
import pytest
from barn import (
    BARN,
    EMPTY_HAND,
    FULL,
    HELD,
    NOT_HELD,
    NOTHING_ATOP,
    ON,
    ON_NOTHING,
    barn,
)
from notebook import Notebook, atom, instance

from skillwrapper.grounding import AtomSpace
from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.learning.version_space import Prior, VersionSpace, version_spaces
from skillwrapper.symbols import Literal, Predicate, Variable

EVERYTHING = {EMPTY_HAND, NOT_HELD, NOTHING_ATOP, ON_NOTHING}
TELLING = "on(b, f) on(f, b) full(h)"
"""Lets on vary over the data, and speaks against nothing alone."""


def space(notebook: Notebook, number: int = 0, **options: float) -> VersionSpace:
    return version_spaces(notebook.fit(), "Lift", **options)[number]  # type: ignore[arg-type]


def success(found: VersionSpace, notebook: Notebook, state: str, skill: str) -> float:
    atoms = AtomSpace(notebook.predicates, BARN.objects)
    wanted = instance(skill)
    row = np.array([[str(a) in state for a in atoms.atoms]], dtype=np.int8)
    arguments = np.array([atoms.index.numbers(wanted.arguments)])
    return float(
        found.success_probability(atoms, Attempts.everywhere(AbstractStates(row), arguments))[0]
    )


def test_what_nothing_speaks_of_is_as_likely_as_conditions_of_its_kind() -> None:
    found, prior = space(barn("full(h)", TELLING)), Prior()
    assert set(found.conditions) == EVERYTHING
    assert found.probability[NOT_HELD] == pytest.approx(prior.negative)
    assert found.probability[NOTHING_ATOP] == pytest.approx(prior.absence)


def test_the_only_explanation_of_a_failure_is_proven() -> None:
    found = space(barn("full(h)", TELLING))
    assert found.proven == {EMPTY_HAND}
    assert found.open == EVERYTHING - {EMPTY_HAND}
    assert found.probability[EMPTY_HAND] == pytest.approx(1.0)
    assert found.most_general == ({EMPTY_HAND},)


def test_of_two_explanations_none_is_proven_and_both_are_likelier() -> None:
    found, prior = space(barn("full(h) on(b, a)", "held(a) on(a, b)")), Prior()
    assert found.proven == set()
    assert set(found.most_general) == {
        frozenset({one, other})
        for one in (EMPTY_HAND, NOTHING_ATOP)
        for other in (NOT_HELD, ON_NOTHING)
    }
    for condition in EVERYTHING:
        assert prior.of(condition) < found.probability[condition] < 1


def test_a_try_succeeds_unless_something_unmet_is_needed() -> None:
    notebook = barn("full(h)", TELLING)
    found = space(notebook)
    assert success(found, notebook, "", "Lift(h, a)") == pytest.approx(1.0)
    assert success(found, notebook, "full(h)", "Lift(h, a)") == pytest.approx(0.0)
    for state, condition in (("held(a)", NOT_HELD), ("on(b, a)", NOTHING_ATOP)):
        wanted = 1 - found.probability[condition]
        assert success(found, notebook, state, "Lift(h, a)") == pytest.approx(wanted)
    both = (1 - found.probability[NOT_HELD]) * (1 - found.probability[NOTHING_ATOP])
    assert success(found, notebook, "held(a) on(b, a)", "Lift(h, a)") == pytest.approx(both)


def test_doubtful_failures_prove_less_and_more_of_them_prove_more() -> None:
    once = space(barn("full(h)", TELLING), doubt=0.2)
    twice = space(barn("full(h)", "full(h)#2", TELLING), doubt=0.2)
    sure = space(barn("full(h)", TELLING))
    likely = [found.probability[EMPTY_HAND] for found in (once, twice, sure)]
    assert Prior().negative < likely[0] < likely[1] < likely[2]
    assert once.proven == sure.proven


def test_what_one_operator_needs_the_others_are_likely_to_need() -> None:
    """Crates are lifted from the ground, or off another one, with an empty hand either way."""
    notebook = barn("full(h)", TELLING)
    notebook.success("on(a, b)", "Lift(h, a)", "full(h) held(a)")
    off_another = space(notebook)
    assert EMPTY_HAND in off_another.open
    assert off_another.probability[EMPTY_HAND] > 0.9


def test_what_only_tells_operators_apart_is_not_passed_on() -> None:
    """Crates that stand on nothing are lifted otherwise, which is no reason why others are not."""
    notebook = barn("full(h)", TELLING)
    alone = space(notebook).probability[ON_NOTHING]
    notebook.success("on(a, b)", "Lift(h, a)", "full(h) held(a)")
    off_another, off_the_ground = (space(notebook, number) for number in (0, 1))
    assert ON_NOTHING in off_the_ground.proven
    assert off_another.probability[ON_NOTHING] == pytest.approx(alone)


def test_narrow_types_are_a_condition() -> None:
    frail = Variable("?crate_1", ("frail",))
    found = space(barn(crates="f"))
    assert found.probability[frail] == pytest.approx(Prior().types)
    assert frail in space(barn("", crates="f")).proven


def test_without_conditions_there_is_one_hypothesis() -> None:
    notebook = Notebook(BARN, FULL, ON, HELD)
    notebook.success("", "Lift(h, a)", "")
    found = space(notebook)
    assert (found.conditions, found.most_general, found.proven) == ((), (frozenset(),), set())


def test_of_many_conditions_hypotheses_are_drawn_and_certain_ones_kept() -> None:
    from skillwrapper.learning import version_space  # noqa: PLC0415

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(version_space, "_ENUMERATED", 0)
        drawn = space(barn("full(h)", TELLING))
    enumerated = space(barn("full(h)", TELLING))
    assert drawn.proven >= {EMPTY_HAND}
    for condition in EVERYTHING:
        likely = enumerated.probability[condition]
        assert drawn.probability[condition] == pytest.approx(likely, abs=0.05)


def test_types_that_a_literal_implies_are_no_more_needed_than_the_literal() -> None:
    """That only frail crates can be whole does not say that only frail crates are lifted."""
    whole = Predicate("whole", ("frail",))
    notebook = Notebook(BARN, FULL, whole)
    notebook.success("whole(f)", "Lift(h, f)", "full(h) whole(f)")
    notebook.failure("full(h)", "Lift(h, f)")
    found = space(notebook)
    conditions = Variable("?crate_1", ("frail",)), Literal(atom("whole(?crate_1)"))
    assert found.open.issuperset(conditions)
    neither = np.prod([1 - found.probability[condition] for condition in conditions])
    assert success(found, notebook, "", "Lift(h, a)") == pytest.approx(neither)

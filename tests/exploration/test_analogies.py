"""What other skills need tells where a skill that never succeeded may work."""

from __future__ import annotations

import numpy as np
import pytest
from barn import AT, FULL
from notebook import Notebook, make_domain

from skillwrapper.exploration.analogies import newness
from skillwrapper.exploration.beliefs import Beliefs
from skillwrapper.grounding import AtomSpace
from skillwrapper.world import Scene, SkillInstance

YARD = make_domain(
    types={"hand": (), "crate": (), "frail": ("crate",), "shelf": (), "low": ("shelf",)},
    objects={"h": "hand", "a": "crate", "f": "frail", "s": "shelf", "l": "low"},
    skills={"Lift": "hand crate", "Break": "frail hand"},
)
SCENE = Scene("", YARD.objects)
BREAK = (SkillInstance("Break", ("f", "h")),)
FREE_ON_LOW, FULL_ON_LOW, FREE_ON_SHELF = "at(f, l)", "full(h) at(f, l)", "at(f, s)"


def yard(*, lifted: bool) -> Notebook:
    """A frail crate failed to break: on the low shelf by a full hand, elsewhere by a free one."""
    notebook = Notebook(YARD, FULL, AT)
    notebook.failure(FULL_ON_LOW, "Break(f, h)")
    notebook.failure(FREE_ON_SHELF, "Break(f, h)")
    notebook.failure("", "Break(f, h)")
    if lifted:
        notebook.success("at(a, s)", "Lift(h, a)", "full(h)")
        notebook.success("at(a, l)", "Lift(h, a)", "full(h)")
        notebook.failure("full(h) at(a, s)", "Lift(h, a)")
        notebook.failure("", "Lift(h, a)")
    return notebook


def alone(notebook: Notebook, *states: str) -> list[float]:
    """How new it is to break the crate in some states."""
    fit = notebook.fit()
    space = AtomSpace(fit.predicates, SCENE.objects)
    rows = [[str(atom) in state for atom in space.atoms] for state in states]
    found = Beliefs().expect(fit, space, np.array(rows, dtype=np.int8), BREAK, doubt=0.01)
    return found.alone[:, 0].tolist()


def test_what_failed_only_where_no_other_skill_works_is_new_where_one_does() -> None:
    assert alone(yard(lifted=False), FREE_ON_LOW, FULL_ON_LOW, FREE_ON_SHELF) == [0, 0, 0]
    new, full, same = alone(yard(lifted=True), FREE_ON_LOW, FULL_ON_LOW, FREE_ON_SHELF)
    assert new >= 0.25
    assert full == same == 0


@pytest.mark.parametrize(("member", "expected"), [(True, [1.0, 0.5, 0.0]), (False, [0.0] * 3)])
def test_newness_counts_what_no_failure_of_the_same_family_had(member, expected) -> None:
    seen = np.array([[1, 1, 1], [0, 1, 1], [0, 0, 1]], dtype=bool)
    failed = np.array([[0, 0, 1], [1, 1, 1]], dtype=bool)
    failed_members = np.array([[True], [False]])
    found = newness(seen, np.full((3, 1), member), failed, failed_members)
    assert found.tolist() == expected

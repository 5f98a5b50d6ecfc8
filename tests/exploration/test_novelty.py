"""How new attempts are, beside others."""

from __future__ import annotations

import numpy as np
import pytest
from barn import BARN, FULL, HELD, ON
from notebook import Notebook

from skillwrapper.exploration.novelty import Earlier, Features, see_features
from skillwrapper.learning.predictions import attempts_of


def seen(*steps: tuple[str, str]) -> Features:
    """What (state, crate) to lift show."""
    notebook = Notebook(BARN, FULL, ON, HELD)
    for before, crate in steps:
        notebook.failure(before, f"Lift(h, {crate})")
    (table,) = notebook.data("Lift")
    return see_features(table.space, attempts_of(table), BARN.types.names)


def same(first: tuple[str, str], second: tuple[str, str]) -> bool:
    one, other = seen(first, second)
    return bool((one == other).all())


@pytest.mark.parametrize(
    ("first", "second", "alike"),
    [
        (("", "a"), ("", "b"), True),
        (("", "a"), ("", "f"), False),  # another type
        (("held(a)", "a"), ("held(b)", "b"), True),
        (("held(a)", "a"), ("held(b)", "a"), False),
        (("on(b, a)", "a"), ("on(a, b)", "b"), True),
        (("on(b, a)", "a"), ("on(a, b)", "a"), False),
        (("on(b, a)", "a"), ("on(f, a)", "a"), False),  # a frail one lies on it
        (("on(b, f)", "a"), ("", "a"), True),  # that is far away
    ],
)
def test_what_is_seen_from_the_arguments(first, second, alike) -> None:
    assert same(first, second) is alike


def test_all_is_new_beside_nothing_and_nothing_beside_itself() -> None:
    own = seen(("held(a)", "a"), ("", "b"))
    first = Earlier(own[:0]).novelty(own)
    assert (first.alone == 1).all()
    assert (first.pairs == 1).all()
    again = Earlier(own).novelty(own)
    assert (again.alone == 0).all()
    assert (again.pairs == 0).all()


def test_known_things_in_a_new_combination_are_new_as_pairs_alone() -> None:
    own = seen(("held(a)", "a"), ("full(h)", "a"), ("full(h) held(a)", "a"))
    found = Earlier(own[:2]).novelty(own[2:])
    assert found.alone.tolist() == [0.0]
    assert 0 < found.pairs[0] < 0.1
    assert np.isfinite(found.pairs).all()

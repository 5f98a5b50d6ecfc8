"""Abstract states as arrays."""

from __future__ import annotations

import numpy as np
import pytest

from skillwrapper.grounding import FALSE
from skillwrapper.grounding.abstract_states import AbstractStates, different_rows


def test_labels_are_looked_up_and_what_is_no_grounding_is_false() -> None:
    states = AbstractStates(np.array([[1, 0, -1], [0, 1, 1]], dtype=np.int8))
    columns = np.array([[0, -1], [2, 1], [-1, -1]])
    found = states.at(np.array([0, 1, 0]), columns)
    assert found.tolist() == [[1, FALSE], [1, 1], [FALSE, FALSE]]


@pytest.mark.parametrize("dtype", [bool, np.int8, np.intp])
def test_different_rows_are_numbered_by_their_first_occurrence(dtype: type) -> None:
    rows = np.array([[0, 1], [1, 1], [0, 1], [1, 0], [1, 1]], dtype=dtype)
    first, place = different_rows(rows)
    assert first.tolist() == [0, 1, 3]
    assert place.tolist() == [0, 1, 0, 2, 1]
    assert (rows[first][place] == rows).all()


@pytest.mark.parametrize(("shape", "number"), [((0, 3), 0), ((3, 0), 1), ((0, 0), 0)])
def test_rows_of_nothing(shape: tuple[int, int], number: int) -> None:
    first, place = different_rows(np.zeros(shape, dtype=bool))
    assert (len(first), len(place)) == (number, shape[0])

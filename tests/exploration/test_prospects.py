"""What an attempt costs: also what can no more be tried after it."""

from __future__ import annotations

import numpy as np
import pytest

from skillwrapper.exploration.lookahead import Lookahead
from skillwrapper.exploration.prospects import price

LEFT = 10
STAY, LEAVE, RING = range(3)


def rooms(*edges: tuple[int, int, int]) -> Lookahead:
    """A room and a yard; ``edges`` are state, instance, and state after."""
    steps = np.array(edges, dtype=np.intp).reshape(-1, 3)
    sure = np.zeros((2, 3), dtype=bool)
    sure[steps[:, 0], steps[:, 1]] = True
    return Lookahead(
        states=np.array([[0], [1]], dtype=np.int8),
        state=np.array([0, 1]),
        roles=np.zeros((2, 1), dtype=np.intp),
        depth=np.array([0, 1]),
        parent=np.array([-1, 0]),
        step=np.array([-1, LEAVE]),
        chance=np.ones(2),
        sure=sure,
        edges=steps,
    )


VALUES = np.array([[0.4, 0.3, 0.2], [0.0, 0.0, 0.1]])
"""Nothing is worth much in the yard."""


def test_where_a_skill_leads_back_only_the_way_counts() -> None:
    found = price(rooms((0, LEAVE, 1), (1, STAY, 0)), VALUES, LEFT)
    assert found[:, RING].tolist() == [1, 2]
    assert found[0, LEAVE] == 1


def test_where_none_leads_back_what_is_given_up_counts_too() -> None:
    found = price(rooms((0, LEAVE, 1)), VALUES, LEFT)
    lost = 1 - 0.1 / 0.4  # the best that is left beside the best that there is
    assert found[0, LEAVE] == pytest.approx(1 + (LEFT - 1) * lost)
    assert found[1, STAY] == pytest.approx(2 + (LEFT - 2) * (1 - 0.1 / 0.3))
    assert found[0, RING] == 1  # it fails, or leads who knows where


def test_a_state_that_was_not_looked_at_may_lead_anywhere() -> None:
    found = price(rooms((0, LEAVE, -1)), VALUES, LEFT)
    assert found[0, LEAVE] == 1


def test_nothing_is_lost_where_nothing_else_is_worth_anything() -> None:
    alone = np.array([[0.0, 0.3, 0.0], [0.0, 0.0, 0.0]])
    assert price(rooms((0, LEAVE, 1)), alone, LEFT)[0, LEAVE] == 1

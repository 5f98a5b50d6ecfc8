"""How much edges count: all on a tree, less in cycles."""

from __future__ import annotations

import numpy as np
import pytest

from skillwrapper.perception.decoding.trees import tree_shares


def _shares(nodes: int, *edges: tuple[int, int]) -> list[float]:
    pairs = np.array(edges, dtype=np.intp).reshape(-1, 2)
    return list(map(float, tree_shares(nodes, pairs[:, 0], pairs[:, 1])))


def test_edges_of_a_tree_count_fully() -> None:
    assert _shares(4, (0, 1), (1, 2), (3, 1)) == [1, 1, 1]


def test_edges_of_a_cycle_share() -> None:
    shares = _shares(4, (0, 1), (1, 2), (2, 0), (2, 3))
    assert shares[3] == 1
    assert sum(shares[:3]) == pytest.approx(2, abs=0.1)
    assert min(shares) > 0


def test_there_and_back_counts_once() -> None:
    assert sum(_shares(2, (0, 1), (1, 0))) == pytest.approx(1, abs=0.1)


def test_no_edges_are_no_mistake() -> None:
    assert _shares(3) == []

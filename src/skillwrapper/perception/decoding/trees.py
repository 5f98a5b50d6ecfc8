"""How much each edge of a graph with cycles may count.

Where pictures are seen again, evidence comes back to where it came from, and passing messages as
on a tree would count it several times. Tree-reweighted message passing (Wainwright, Jaakkola and
Willsky, 2005) lets every edge count by the share of spanning trees that it is part of.
"""

from __future__ import annotations

import random

import numpy as np
from numpy.typing import NDArray

_TREES = 16
"""How many spanning trees are drawn; only edges in cycles depend on chance."""


def tree_shares(
    nodes: int, before: NDArray[np.intp], after: NDArray[np.intp]
) -> NDArray[np.float64]:
    """The share (edges,) of random spanning forests that each edge is part of, above 0.

    Args:
        nodes: number of nodes.
        before: one end (edges,) of each edge.
        after: the other end (edges,); none is the same.
    """
    chance, edges = random.Random(0), list(zip(before.tolist(), after.tolist(), strict=True))
    order = list(range(len(edges)))
    counted = [0] * len(edges)
    for _ in range(_TREES):
        chance.shuffle(order)
        root = list(range(nodes))
        for edge in order:
            one, other = (_find(root, node) for node in edges[edge])
            if one != other:
                root[one] = other
                counted[edge] += 1
    return (np.array(counted, dtype=np.float64) + 0.5) / (_TREES + 0.5)


def _find(root: list[int], node: int) -> int:
    while root[node] != node:
        root[node] = root[root[node]]
        node = root[node]
    return node

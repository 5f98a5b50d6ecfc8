"""What is within reach: states to which skills lead that surely work, as far as the model knows."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.roles import Roles, SceneRoles
from skillwrapper.grounding import Labels
from skillwrapper.grounding.search import StateGraph


@dataclass(frozen=True, eq=False)
class Lookahead:
    """Nodes within reach, the present one first; a node is a state and the roles of its objects.

    Attributes:
        states: the different abstract states (states, atoms).
        state: the state (nodes,) of every node.
        roles: the roles of the objects (nodes, objects).
        depth: how many skills lead there (nodes,).
        parent: the node before (nodes,); -1 for the first one.
        step: the number of the skill instance that leads there (nodes,); -1 for the first one.
        chance: how likely one gets there (nodes,), as far as one can rely on the model's ways.
        sure: whether an instance surely applies (states, instances).
        edges: state, instance and state after of what surely applies (edges, 3);
            -1 after where that is none of these states.
    """

    states: Labels
    state: NDArray[np.intp]
    roles: Roles
    depth: NDArray[np.intp]
    parent: NDArray[np.intp]
    step: NDArray[np.intp]
    chance: NDArray[np.float64]
    sure: NDArray[np.bool_]
    edges: NDArray[np.intp]

    def path(self, node: int) -> list[int]:
        """The numbers of the skill instances that lead to a node."""
        path: list[int] = []
        while node > 0:
            path.append(int(self.step[node]))
            node = int(self.parent[node])
        return path[::-1]


def look_ahead(
    graph: StateGraph,
    start: Labels,
    roles: Roles,
    scene: SceneRoles,
    *,
    depth: int,
    most: int,
    blocked: Collection[int] = (),
    reliability: NDArray[np.float64] | None = None,
) -> Lookahead:
    """Search breadth-first.

    At most half of the nodes are states again that were there before, with other roles.

    Args:
        graph: the states of the model.
        start: abstract state (atoms,) now.
        roles: the roles of the objects (objects,) now.
        scene: the skill instances.
        depth: at most so many skills are looked ahead.
        most: nodes are only added while there are fewer than so many.
        blocked: numbers of instances that are no way from here, whatever the model says.
        reliability: of every instance (instances,), how likely it leads where it is said to;
            None for surely.
    """
    nodes = [(graph.add(start), roles)]
    known, states = {(nodes[0][0], roles.tobytes())}, {nodes[0][0]}
    again = most // 2
    parent, step = [-1], [-1]
    layer = [0]
    for _ in range(depth):
        after: list[int] = []
        for node, state, number in _steps(graph, [nodes[n][0] for n in layer], layer, scene):
            if node == 0 and number in blocked:
                continue
            then = scene.after(nodes[node][1], number)
            key = (state, then.tobytes())
            if key not in known and len(nodes) < most and (state not in states or again):
                again -= state in states
                known.add(key)
                states.add(state)
                after.append(len(nodes))
                nodes.append((state, then))
                parent.append(node)
                step.append(number)
        layer = after
        if not layer:
            break
    return _as_arrays(graph, scene, nodes, parent, step, reliability)


def roll_out(
    graph: StateGraph, start: Labels, roles: Roles, scene: SceneRoles, sequence: Sequence[int]
) -> Lookahead:
    """The nodes before each skill of a sequence, as far as the model knows.

    A skill that does not surely work changes nothing.
    """
    nodes = [(graph.add(start), roles)]
    for number in sequence[:-1]:
        state, present = nodes[-1]
        following = [after for _, after, n in _steps(graph, [state], [0], scene) if n == number]
        nodes.append((following[0], scene.after(present, number)) if following else nodes[-1])
    parent = list(range(-1, len(nodes) - 1))
    return _as_arrays(graph, scene, nodes, parent, [-1, *sequence[:-1]])


def _as_arrays(
    graph: StateGraph,
    scene: SceneRoles,
    nodes: Sequence[tuple[int, Roles]],
    parent: Sequence[int],
    step: Sequence[int],
    reliability: NDArray[np.float64] | None = None,
) -> Lookahead:
    numbers, state_of = np.unique([state for state, _ in nodes], return_inverse=True)
    depth: list[int] = []
    chance: list[float] = []
    for before, number in zip(parent, step, strict=True):
        depth.append(depth[before] + 1 if before >= 0 else 0)
        works = 1.0 if before < 0 or reliability is None else float(reliability[number])
        chance.append(chance[before] * works if before >= 0 else 1.0)
    edges = _edges(graph, numbers.tolist(), scene)
    sure = np.zeros((len(numbers), len(scene.instances)), dtype=bool)
    sure[edges[:, 0], edges[:, 1]] = True
    return Lookahead(
        graph.states(numbers.tolist()),
        state_of.ravel(),
        np.array([roles for _, roles in nodes], dtype=np.intp),
        np.array(depth, dtype=np.intp),
        np.array(parent, dtype=np.intp),
        np.array(step, dtype=np.intp),
        np.array(chance, dtype=np.float64),
        sure,
        edges,
    )


def _steps(
    graph: StateGraph, states: Sequence[int], nodes: Sequence[int], scene: SceneRoles
) -> list[tuple[int, int, int]]:
    """Node, state after and instance, of the first operator of every instance that applies."""
    found: dict[int, dict[int, int]] = {}
    for state, edge in graph.edges(list(dict.fromkeys(states))):
        found.setdefault(state, {}).setdefault(scene.number[edge.instance], edge.after)
    return [
        (node, after, number)
        for node, state in zip(nodes, states, strict=True)
        for number, after in sorted(found.get(state, {}).items())
    ]


def _edges(graph: StateGraph, states: list[int], scene: SceneRoles) -> NDArray[np.intp]:
    row = {state: number for number, state in enumerate(states)}
    found = [
        (row[state], scene.number[edge.instance], row.get(edge.after, -1))
        for state, edge in graph.edges(states)
    ]
    return np.array(found, dtype=np.intp).reshape(-1, 3)

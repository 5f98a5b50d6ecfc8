"""Searching the abstract states that a model leads to, breadth first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding.atom_space import Labels
from skillwrapper.grounding.models import GroundModel
from skillwrapper.world.skills import SkillInstance

_AT_ONCE = 1024
"""So many states are expanded together."""


@dataclass(frozen=True)
class Edge:
    """An operator that surely applies leads from one abstract state to another.

    Attributes:
        instance: the skill instance.
        after: the number of the state after.
    """

    instance: SkillInstance
    after: int


class StateGraph:
    """Abstract states as numbered nodes, operators that surely apply as edges; grown as asked.

    Args:
        model: the operators.
        limit: no state is expanded once there are more than so many; a wrong model can imagine
            exponentially many.
    """

    def __init__(self, model: GroundModel, limit: int) -> None:
        self._model, self._limit = model, limit
        self._rows: list[Labels] = []
        self._number: dict[bytes, int] = {}
        self._edges: dict[int, list[Edge]] = {}

    @property
    def is_full(self) -> bool:
        """Whether the limit is reached."""
        return len(self._rows) > self._limit

    def add(self, state: Labels) -> int:
        """The number of a state (atoms,)."""
        key = state.tobytes()
        number = self._number.setdefault(key, len(self._rows))
        if number == len(self._rows):
            self._rows.append(state)
        return number

    def states(self, nodes: list[int]) -> Labels:
        """The abstract states (nodes, atoms) of some nodes."""
        return np.stack([self._rows[node] for node in nodes])

    def edges(self, nodes: list[int]) -> Iterator[tuple[int, Edge]]:
        """What leads away from each of some nodes, node by node."""
        fresh = [node for node in nodes if node not in self._edges]
        for start in range(0, len(fresh), _AT_ONCE):
            self._expand(fresh[start : start + _AT_ONCE])
        for node in nodes:
            for edge in self._edges[node]:
                yield node, edge

    def _expand(self, nodes: list[int]) -> None:
        for node in nodes:
            self._edges[node] = []
        for bindings in self._model.bind_all(self.states(nodes)):
            sure = bindings.sure
            after = sure.successors()
            for row, instance, state in zip(sure.rows, sure.instances, after, strict=True):
                self._edges[nodes[row]].append(Edge(instance, self.add(state)))


class BreadthFirst:
    """One search from one state, layer by layer; shortest ways first.

    Args:
        graph: where to search.
        start: abstract state (atoms,) to start from.
    """

    def __init__(self, graph: StateGraph, start: Labels) -> None:
        self._graph = graph
        self._start = graph.add(start)
        self._came: dict[int, tuple[int, SkillInstance]] = {}

    def layers(self) -> Iterator[list[int]]:
        """Nodes by their distance from the start; ends early if the graph is full."""
        found, layer = {self._start}, [self._start]
        while layer:
            yield layer
            if self._graph.is_full:
                return
            after: list[int] = []
            for node, edge in self._graph.edges(layer):
                if edge.after not in found:
                    found.add(edge.after)
                    after.append(edge.after)
                    self._came[edge.after] = (node, edge.instance)
            layer = after

    def path_to(self, node: int) -> tuple[SkillInstance, ...]:
        """A shortest sequence of skill instances from the start to a node that was yielded."""
        path: list[SkillInstance] = []
        while node != self._start:
            node, instance = self._came[node]
            path.append(instance)
        return tuple(reversed(path))


def is_reachable(graph: StateGraph, start: Labels, goal: Labels) -> bool | None:
    """Whether an abstract plan leads from one abstract state to another (atoms,).

    Returns:
        None if the limit was reached before it was clear.
    """
    wanted = graph.add(goal)
    for layer in BreadthFirst(graph, start).layers():
        if wanted in layer:
            return True
    return None if graph.is_full else False

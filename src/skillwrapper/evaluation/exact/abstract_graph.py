"""The abstract states that a model's operators lead to, real or imagined."""

from __future__ import annotations

import numpy as np

from skillwrapper.grounding.ground import TRUE, GroundModel, GroundOperator, Labels


class AbstractGraph:
    """Abstract states as nodes, applicable ground operators as edges; grown as far as asked.

    Args:
        model: the ground operators.
        limit: at most so many abstract states are looked at; a wrong model can imagine
            exponentially many.
    """

    def __init__(self, model: GroundModel, limit: int) -> None:
        self._operators: list[GroundOperator] = [
            operator for found in model.operators.values() for operator in found
        ]
        self._limit = limit
        self._rows: list[Labels] = []
        self._number: dict[bytes, int] = {}
        self._successors: dict[int, list[int]] = {}

    def is_reachable(self, start: Labels, goal: Labels) -> bool | None:
        """Whether an abstract plan leads from one abstract state to another (shapes: atoms).

        Returns:
            None if the limit was reached before it was clear.
        """
        goal_number = self._add(goal)
        found = {self._add(start)}
        frontier = sorted(found)
        while frontier:
            if goal_number in found:
                return True
            if len(self._rows) > self._limit:
                return None
            self._expand([node for node in frontier if node not in self._successors])
            reached = {after for node in frontier for after in self._successors[node]}
            frontier = sorted(reached - found)
            found |= reached
        return goal_number in found

    def _add(self, row: Labels) -> int:
        key = row.tobytes()
        number = self._number.setdefault(key, len(self._rows))
        if number == len(self._rows):
            self._rows.append(row)
        return number

    def _expand(self, nodes: list[int]) -> None:
        if not nodes:
            return
        states = np.stack([self._rows[node] for node in nodes])
        for node in nodes:
            self._successors[node] = []
        for operator in self._operators:
            applies = np.flatnonzero(operator.applicability(states) == TRUE)
            for position, after in zip(applies, operator.apply(states[applies]), strict=True):
                self._successors[nodes[position]].append(self._add(after))

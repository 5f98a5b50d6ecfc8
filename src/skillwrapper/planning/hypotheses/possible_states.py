"""The states that can come about in a scene, as far as its model tells, and ways between them."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.grounding.search import StateGraph
from skillwrapper.perception.acquaintance import FamiliarStates
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.planning.result import SkillPlan
from skillwrapper.world.skills import SkillInstance

Steps = Mapping[SkillInstance, int]
"""What leads away from a state: skill instances with the number of the state after."""


@dataclass(frozen=True, eq=False)
class Course:
    """A plan as the model expects it.

    Attributes:
        states: numbers of the states after each skill that is expected to succeed.
        fails: whether the skill after these is expected to fail.
    """

    states: tuple[int, ...]
    fails: bool


@dataclass(frozen=True, eq=False)
class PossibleStates:
    """States as numbers, and what the model says of skills in them.

    Attributes:
        labels: the abstract states (states, atoms), of TRUE and FALSE only.
        nats: how surely each (states,) can come about: as the surest state that leads to it.
        steps: for every state what leads away from it.
    """

    labels: Labels
    nats: Floats
    steps: tuple[Steps, ...]
    _arrivals: dict[int, Mapping[int, tuple[int, SkillInstance]]] = field(
        default_factory=dict, repr=False
    )

    @classmethod
    def explore(
        cls, model: GroundModel, familiar: FamiliarStates, limit: int
    ) -> PossibleStates | None:
        """All states that the model leads to from some that are known to occur.

        Args:
            model: the operators.
            familiar: states that are known to occur, the surest first.
            limit: how many are listed at most.

        Returns:
            None if even the surest state leads to more, or none is known.
        """
        graph = StateGraph(model, limit)
        steps: dict[int, dict[SkillInstance, int]] = {}
        nats: list[float] = []
        for row, sure in zip(familiar.labels, familiar.nats.tolist(), strict=True):
            found = _spread(graph, graph.add(row), steps)
            if graph.is_full:
                break
            steps |= found
            nats += [sure] * len(found)
        if not steps:
            return None
        nodes = sorted(steps)  # a spread that was broken off has left numbers unused at the end
        return cls(graph.states(nodes), np.array(nats), tuple(steps[node] for node in nodes))

    def __len__(self) -> int:
        return len(self.steps)

    def plan(self, start: int, goals: Collection[int]) -> SkillPlan | None:
        """A shortest plan from a state to one of several; None if the model knows none."""
        arrivals = self._arrivals_from(start)
        goal = next((state for state in arrivals if state in goals), None)
        if goal is None:
            return None
        plan: list[SkillInstance] = []
        while goal != start:
            goal, instance = arrivals[goal]
            plan.append(instance)
        return tuple(reversed(plan))

    def course(self, start: int, plan: Sequence[SkillInstance]) -> Course:
        """What becomes of a plan in a state, as the model says."""
        states: list[int] = []
        now = start
        for instance in plan:
            after = self.steps[now].get(instance)
            if after is None:
                return Course(tuple(states), fails=True)
            now = after
            states.append(now)
        return Course(tuple(states), fails=False)

    def _arrivals_from(self, start: int) -> Mapping[int, tuple[int, SkillInstance]]:
        """For every state that is reached, nearest first: the one before, and how."""
        if start not in self._arrivals:
            found: dict[int, tuple[int, SkillInstance]] = {start: (start, SkillInstance("", ()))}
            waiting = deque([start])
            while waiting:
                node = waiting.popleft()
                for instance, after in self.steps[node].items():
                    if after not in found:
                        found[after] = (node, instance)
                        waiting.append(after)
            self._arrivals[start] = found
        return self._arrivals[start]


def _spread(
    graph: StateGraph, start: int, known: Mapping[int, Mapping[SkillInstance, int]]
) -> dict[int, dict[SkillInstance, int]]:
    """What leads away from a state, and from all that it leads to, but for what is known."""
    steps: dict[int, dict[SkillInstance, int]] = {} if start in known else {start: {}}
    layer = list(steps)
    while layer and not graph.is_full:
        found: list[int] = []
        for node, edge in graph.edges(layer):
            # Of several operators that apply the first one counts, as in simulation.
            steps[node].setdefault(edge.instance, edge.after)
            if edge.after not in steps and edge.after not in known:
                steps[edge.after] = {}
                found.append(edge.after)
        layer = found
    return steps

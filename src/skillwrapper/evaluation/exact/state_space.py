"""The whole true state space of a scene of a domain that can list its states."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillwrapper.world.capabilities import Enumerable
from skillwrapper.world.skills import SkillInstance, ground_skills


@dataclass(frozen=True)
class StateSpace:
    """Every reachable state with the outcome of every skill instance.

    Attributes:
        states: the reachable states, the start first.
        instances: all skill instances over the objects of the scene.
        success: whether an instance succeeds in a state (states, instances).
        following: index of the state after a success (states, instances); a state's own index
            where the instance fails.
    """

    states: tuple[Any, ...]
    instances: tuple[SkillInstance, ...]
    success: NDArray[np.bool_]
    following: NDArray[np.intp]

    @classmethod
    def of(cls, environment: Enumerable) -> StateSpace:
        """Run every skill instance in every state that the start of the present scene leads to."""
        domain = environment.domain
        states = tuple(environment.reachable_states())
        instances = ground_skills(domain.skills, environment.scene.objects)
        index = {state: number for number, state in enumerate(states)}
        success = np.zeros((len(states), len(instances)), dtype=np.bool_)
        following = np.repeat(np.arange(len(states))[:, np.newaxis], len(instances), axis=1)
        for row, state in enumerate(states):
            for column, instance in enumerate(instances):
                succeeded, after = environment.successor(state, instance)
                if succeeded:
                    success[row, column] = True
                    following[row, column] = index[after]
        return cls(states, instances, success, following)

    def path_to(self, state: int) -> tuple[SkillInstance, ...]:
        """A shortest sequence of skill instances that leads from the start to a state."""
        steps = []
        while state != 0:
            state, instance = self._arrivals[state]
            steps.append(self.instances[instance])
        return tuple(reversed(steps))

    def distances_from(self, start: int) -> NDArray[np.intp]:
        """Number of skills on a shortest path from a state to every state (states,).

        Returns:
            -1 for a state that cannot be reached, which the search of all paths has proven.
        """
        distances = np.full(len(self.states), -1, dtype=np.intp)
        frontier, steps = np.array([start], dtype=np.intp), 0
        while len(frontier):
            distances[frontier] = steps
            reached = np.unique(self.following[frontier][self.success[frontier]])
            frontier, steps = reached[distances[reached] < 0], steps + 1
        return distances

    def path_between(self, start: int, goal: int) -> tuple[SkillInstance, ...] | None:
        """A shortest sequence of skill instances from a state to another; None if there is none."""
        remaining = self.distances_from(start)
        if remaining[goal] < 0:
            return None
        steps = []
        while goal != start:
            before, instance = np.nonzero(self.success & (self.following == goal))
            nearest = int(np.flatnonzero(remaining[before] == remaining[goal] - 1)[0])
            goal = int(before[nearest])
            steps.append(self.instances[int(instance[nearest])])
        return tuple(reversed(steps))

    @cached_property
    def index(self) -> Mapping[Any, int]:
        """The number of every state."""
        return {state: number for number, state in enumerate(self.states)}

    @cached_property
    def distance(self) -> NDArray[np.intp]:
        """Number of skills on a shortest path from the start to every state (states,)."""
        distances = np.zeros(len(self.states), dtype=np.intp)
        for state, (before, _) in self._arrivals.items():
            distances[state] = distances[before] + 1
        return distances

    @cached_property
    def _arrivals(self) -> Mapping[int, tuple[int, int]]:
        """For every state but the start: the state before and the instance, breadth first."""
        arrivals: dict[int, tuple[int, int]] = {}
        waiting = deque([0])
        while waiting:
            state = waiting.popleft()
            for instance in np.flatnonzero(self.success[state]):
                after = int(self.following[state, instance])
                if after != 0 and after not in arrivals:
                    arrivals[after] = (state, int(instance))
                    waiting.append(after)
        return arrivals

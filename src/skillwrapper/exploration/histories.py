"""Which skills had to do with every object in an episode: what no predicate may tell.

A skill has to do with its arguments and with every object of which it changes what is known: what
was in the washing machine was washed. One that seems to change nothing may have to do with all that
stands in a relation to its arguments. A skill that never succeeded may need just that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.roles import SceneRoles
from skillwrapper.grounding import TRUE, AtomSpace, Labels
from skillwrapper.grounding.search import StateGraph

Deeds = NDArray[np.int64]
"""For every object (..., objects) a set of skills, a bit each."""

View = frozenset[tuple[str, tuple[int | str, ...]]]
"""What holds of the arguments of an instance: predicates with their places, and names of others."""

History = tuple[tuple[int, ...], View]
"""What was done with each of the arguments, and what holds of them."""


class Histories:
    """What had been done with the arguments, and what was seen of them, whenever a skill was tried.

    Attributes:
        tries: how often each skill was tried.
    """

    def __init__(self) -> None:
        self._tried: dict[str, set[History]] = {}
        self.tries: Counter[str] = Counter()

    def note(self, skill: str, history: History) -> None:
        """Take note of an attempt."""
        self._tried.setdefault(skill, set()).add(history)
        self.tries[skill] += 1

    def is_new(self, skill: str, history: History) -> bool:
        """Whether a skill was never tried after that."""
        return history not in self._tried.get(skill, ())

    def different(self, skill: str) -> int:
        """After how many different deeds a skill was tried."""
        return len({deeds for deeds, _ in self._tried.get(skill, ())})


class Touched:
    """Tells with which objects of a scene skill instances have to do.

    Args:
        scene: the skill instances.
        space: the ground atoms.
        skills: names of all skills, in the order of their bits.
        silent: skills of which no success seems to change anything.
    """

    def __init__(
        self,
        scene: SceneRoles,
        space: AtomSpace,
        skills: Sequence[str],
        silent: Collection[str] = (),
    ) -> None:
        self._scene, self._space = scene, space
        self._silent = [instance.skill in silent for instance in scene.instances]
        bit = {name: np.int64(1 << number) for number, name in enumerate(skills)}
        self._bits = [bit[instance.skill] for instance in scene.instances]
        self._arguments = np.zeros((len(scene.instances), len(space.objects)), dtype=np.int64)
        for number, places in enumerate(scene.places):
            self._arguments[number, places] = self._bits[number]

    def by(self, instance: int, before: Labels, after: Labels) -> Deeds:
        """What an instance does with the objects (objects,).

        Args:
            instance: number of the instance.
            before: labels (atoms,) of the state in which it runs.
            after: those of the state in which it ends.
        """
        meant: NDArray[np.bool_] = self._space.mentions[before != after].any(axis=0)
        if self._silent[instance]:
            of_arguments = self._space.mentions[:, self._arguments[instance] > 0].any(axis=1)
            meant = meant | self._space.mentions[of_arguments & (before == TRUE)].any(axis=0)
        deeds: Deeds = self._arguments[instance] | meant * self._bits[instance]
        return deeds

    def history(self, instance: int, deeds: Deeds, labels: Labels) -> History:
        """The history of an attempt now.

        Args:
            instance: number of the instance.
            deeds: what was done with the objects (objects,) so far.
            labels: of the state (atoms,) in which it is tried.
        """
        places = self._scene.places[instance]
        names = {self._space.objects[n].name: place for place, n in enumerate(places.tolist())}
        seen = np.flatnonzero(
            self._space.mentions[:, places].any(axis=1) & (labels == TRUE)
        ).tolist()
        atoms = [self._space.atoms[n] for n in seen]
        view = frozenset((a.predicate, tuple(names.get(t, t) for t in a.terms)) for a in atoms)
        return tuple(deeds[places].tolist()), view


def nearest_unheard(
    graph: StateGraph,
    start: Labels,
    deeds: Deeds,
    scene: SceneRoles,
    touched: Touched,
    histories: Histories,
    *,
    skills: Collection[str],
    depth: int,
    most: int,
    blocked: Collection[int] = (),
) -> tuple[int, ...]:
    """The shortest way to an attempt at one of some skills after a history that is new for it.

    Numbers of skill instances, the last of which is the attempt; empty if there is no such way.

    Args:
        graph: the states of the model.
        start: abstract state (atoms,) now.
        deeds: what was done with the objects (objects,) so far.
        scene: the skill instances.
        touched: tells what is done with them on the way.
        histories: of earlier attempts.
        skills: names of the skills in question.
        depth: at most so many skills are looked ahead.
        most: so many states, with what was done by then, are looked at.
        blocked: numbers of instances that lead nowhere from here, whatever the model says.
    """
    asked = [n for n, instance in enumerate(scene.instances) if instance.skill in skills]
    matters = np.zeros(len(deeds), dtype=bool)
    matters[[place for n in asked for place in scene.places[n].tolist()]] = True
    nodes = [(graph.add(start), deeds * matters)]
    came: list[tuple[int, int]] = [(-1, -1)]
    known, layer = {(nodes[0][0], nodes[0][1].tobytes())}, [0]
    for ahead in range(depth + 1):
        for node in layer:
            for number in asked:
                state, done = nodes[node]
                history = touched.history(number, done, graph.states([state])[0])
                is_new = histories.is_new(scene.instances[number].skill, history)
                if is_new and (node or number not in blocked):
                    return (*_path(came, node), number)
        if ahead == depth:
            break
        following: list[int] = []
        for node in layer:
            state, done = nodes[node]
            for _, edge in graph.edges([state]):
                number = scene.number[edge.instance]
                if len(nodes) >= most or (node == 0 and number in blocked):
                    continue
                before, after = graph.states([state, edge.after])
                then = done | touched.by(number, before, after) * matters
                key = (edge.after, then.tobytes())
                if key not in known:
                    known.add(key)
                    following.append(len(nodes))
                    nodes.append((edge.after, then))
                    came.append((node, number))
        layer = following
    return ()


def _path(came: Sequence[tuple[int, int]], node: int) -> list[int]:
    path: list[int] = []
    while node > 0:
        node, number = came[node]
        path.append(number)
    return path[::-1]

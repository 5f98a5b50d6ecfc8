"""Chains of hidden states: which pictures follow each other, and what was done in between.

A state may be seen in several pictures; every picture is a node. What a skill does not touch
persists along an edge, and what it changes, it changes by a rule; so neighbours tell of each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from skillwrapper.perception.decoding.trees import tree_shares
from skillwrapper.transitions.recorded import RecordedTransition, RecordedTransitions
from skillwrapper.world.domain import Domain
from skillwrapper.world.scenes import Scene


class StepKind(StrEnum):
    """What lies between two pictures."""

    SUCCESS = "success"
    FAILURE = "failure"
    """Of a skill that is not known to leave the state as it was."""
    RESET = "reset"
    """From the first start of a scene to another one."""
    SAME = "same"
    """Two pictures of one state: nothing was changed in between, or a reset brought it back, as
    domain or robot say (D8, D11)."""


@dataclass(frozen=True)
class Step:
    """What was done between two pictures.

    Attributes:
        kind: what it is.
        skill: name of the skill; empty for ``RESET`` and ``SAME``.
        arguments: names of its objects.
    """

    kind: StepKind
    skill: str = ""
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Chain:
    """The pictures of one scene, and the steps between them, each once.

    Attributes:
        scene: the objects.
        nodes: number of pictures.
        steps: the different steps.
        before: for every edge (edges,) the picture before.
        after: for every edge (edges,) the picture after; the same where only a skill's success
            is told by the edge.
        which: for every edge (edges,) the index into ``steps``.
    """

    scene: Scene
    nodes: int
    steps: tuple[Step, ...]
    before: NDArray[np.intp]
    after: NDArray[np.intp]
    which: NDArray[np.intp]

    @cached_property
    def moves(self) -> NDArray[np.intp]:
        """The edges between different pictures."""
        return np.flatnonzero(self.before != self.after)

    @cached_property
    def weights(self) -> NDArray[np.float64]:
        """How much each of the moves may count, above 0 and at most 1."""
        return tree_shares(self.nodes, self.before[self.moves], self.after[self.moves])


def chains_of(recorded: RecordedTransitions) -> tuple[Chain, ...]:
    """One chain for every scene; its nodes are the scene's observations."""
    edges: dict[Scene, dict[tuple[int, int, Step], None]] = {s: {} for s in recorded.scenes}
    for scene, edge in _edges(recorded):
        edges[scene][edge] = None
    return tuple(
        _chain(scene, len(recorded.observations(scene)), tuple(edges[scene]))
        for scene in recorded.scenes
    )


def chain_of_starts(scene: Scene, starts: int, *, restored: bool) -> Chain:
    """The chain of pictures that were taken after resets alone.

    Args:
        scene: the objects.
        starts: number of pictures, at least one.
        restored: whether all show the same state.
    """
    step = Step(StepKind.SAME if restored else StepKind.RESET)
    return _chain(scene, starts, tuple((0, start, step) for start in range(1, starts)))


def _chain(scene: Scene, nodes: int, edges: tuple[tuple[int, int, Step], ...]) -> Chain:
    number = {step: place for place, step in enumerate(dict.fromkeys(s for _, _, s in edges))}
    rows = np.array([(b, a, number[s]) for b, a, s in edges], dtype=np.intp).reshape(-1, 3)
    return Chain(scene, nodes, tuple(number), rows[:, 0], rows[:, 1], rows[:, 2])


def _edges(recorded: RecordedTransitions) -> Iterator[tuple[Scene, tuple[int, int, Step]]]:
    """All edges, in order of time."""
    own = {record.scene: record.before for record in reversed(recorded.records)}
    for record in recorded.records:
        step = _step(record, recorded.domain)
        if step is not None:
            yield record.scene, (record.before, record.after, step)
    restores = recorded.domain.resets_restore_state
    kind = StepKind.SAME if restores else StepKind.RESET
    for scene, start in _starts(recorded):
        if start != own[scene]:
            yield scene, (own[scene], start, Step(kind))
    for one, other in pairwise(recorded.records):
        if _is_next(one, other) and one.after != other.before:
            yield one.scene, (one.after, other.before, Step(StepKind.SAME))


def _step(record: RecordedTransition, domain: Domain) -> Step | None:
    instance = record.transition.instance
    if record.transition.success:
        return Step(StepKind.SUCCESS, instance.skill, instance.arguments)
    if record.unchanged or record.before == record.after:
        return None
    return Step(StepKind.FAILURE, instance.skill, instance.arguments)


def _starts(recorded: RecordedTransitions) -> Iterator[tuple[Scene, int]]:
    """What was seen after resets: where a record does not begin with what was seen last."""
    for number, record in enumerate(recorded.records):
        if number == 0 or not _is_next(recorded.records[number - 1], record):
            yield record.scene, record.before


def _is_next(one: RecordedTransition, other: RecordedTransition) -> bool:
    last, first = one.transition.after, other.transition.before
    return one.scene == other.scene and last.key == first.key

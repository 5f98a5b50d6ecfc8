"""Recorded transitions: what was executed so far, with the pictures that were taken."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from skillwrapper.transitions.executions import Executions
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True)
class RecordedTransition:
    """A transition with its place among all.

    Attributes:
        transition: the transition.
        scene: the objects present.
        before: number of the observation before, among the scene's observations.
        after: number of the observation whose labels count as those after.
        unchanged: whether the state is known not to have changed.
    """

    transition: Transition
    scene: Scene
    before: int
    after: int
    unchanged: bool


class RecordedTransitions:
    """All transitions so far, in order of time; only ever grows.

    Args:
        domain: types, objects and skills.

    Attributes:
        records: the transitions, by their numbers.
    """

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.records: list[RecordedTransition] = []
        self._observations: dict[Scene, list[Observation]] = {}
        self._numbers: dict[Scene, dict[str, int]] = {}
        self._executions: dict[Scene, Executions] = {}

    @classmethod
    def of(cls, domain: Domain, episodes: Iterable[Episode]) -> RecordedTransitions:
        """The transitions of several episodes, in their order."""
        recorded = cls(domain)
        for episode in episodes:
            recorded.add(episode)
        return recorded

    def __len__(self) -> int:
        return len(self.records)

    def add(self, episode: Episode) -> None:
        """Add the transitions of an episode."""
        for transition in episode.transitions:
            before = self._number(episode.scene, transition.before)
            # D11: a label may be copied instead of read only if that is known to be right.
            unchanged = self._is_unchanged(transition)
            after = before if unchanged else self._number(episode.scene, transition.after)
            record = RecordedTransition(transition, episode.scene, before, after, unchanged)
            self.records.append(record)
        self._executions.pop(episode.scene, None)

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes, in the order of their first episode."""
        return tuple(self._observations)

    def count_by_skill(self) -> Counter[str]:
        """How often each skill was run."""
        return Counter(record.transition.instance.skill for record in self.records)

    def observations(self, scene: Scene) -> tuple[Observation, ...]:
        """The different observations of a scene, in order of time."""
        return tuple(self._observations[scene])

    def number_of(self, scene: Scene, observation: Observation) -> int | None:
        """The number of an observation among the scene's; None if it is not recorded."""
        return self._numbers.get(scene, {}).get(observation.key)

    def executions(self, scene: Scene) -> Executions:
        """What was run in a scene; its states are the scene's observations."""
        if scene not in self._executions:
            self._executions[scene] = self._as_arrays(scene)
        return self._executions[scene]

    def _is_unchanged(self, transition: Transition) -> bool:
        if transition.changed is not None:
            return not transition.changed
        return self.domain.failures_change_nothing and not transition.success

    def _number(self, scene: Scene, observation: Observation) -> int:
        numbers = self._numbers.setdefault(scene, {})
        if observation.key not in numbers:
            numbers[observation.key] = len(numbers)
            self._observations.setdefault(scene, []).append(observation)
        return numbers[observation.key]

    def _as_arrays(self, scene: Scene) -> Executions:
        ids = [i for i, record in enumerate(self.records) if record.scene == scene]
        records = [self.records[i] for i in ids]
        instances = tuple(sorted({r.transition.instance for r in records}))
        place = {instance: number for number, instance in enumerate(instances)}
        return Executions(
            scene,
            instances,
            which=np.array([place[r.transition.instance] for r in records], dtype=np.intp),
            success=np.array([r.transition.success for r in records], dtype=bool),
            before=np.array([r.before for r in records], dtype=np.intp),
            after=np.array([r.after for r in records], dtype=np.intp),
            unchanged=np.array([r.unchanged for r in records], dtype=bool),
            ids=np.array(ids, dtype=np.intp),
        )

"""The data set: all transitions so far, and their pictures' labels as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from skillwrapper.learning.data import SkillData, SkillTable
from skillwrapper.symbols import AtomSpace, Labels, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.types import Object

Scene = tuple[str, ...]
"""Names of the objects that are present."""


class TruthSource(Protocol):
    """Where labels come from; the learner knows nothing of models or prompts."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms) of the ground atoms; never asks twice for the same."""
        ...


@dataclass(frozen=True)
class Record:
    """A transition with its place in the data.

    Attributes:
        transition: the transition.
        scene: the objects present.
        before: row of the observation before among the scene's observations.
        after: row of the observation whose labels count as those after.
    """

    transition: Transition
    scene: Scene
    before: int
    after: int


class Dataset:
    """All transitions so far, in order of time; only ever grows."""

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.records: list[Record] = []
        self._observations: dict[Scene, list[Observation]] = {}
        self._rows: dict[Scene, dict[str, int]] = {}

    def __len__(self) -> int:
        return len(self.records)

    def add(self, episode: Episode) -> None:
        """Add the transitions of an episode."""
        for transition in episode.transitions:
            before = self._row(episode.scene, transition.before)
            # D11: only if the domain says so may a label be copied instead of read.
            copied = self.domain.failures_change_nothing and not transition.success
            after = before if copied else self._row(episode.scene, transition.after)
            self.records.append(Record(transition, episode.scene, before, after))

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes, in the order of their first episode."""
        return tuple(self._observations)

    def objects(self, scene: Scene) -> tuple[Object, ...]:
        """The objects of a scene."""
        return self.domain.scene_objects(scene)

    def observations(self, scene: Scene) -> tuple[Observation, ...]:
        """The different observations of a scene, in order of time."""
        return tuple(self._observations[scene])

    def numbers_of(self, skill: str) -> tuple[int, ...]:
        """Numbers of the transitions of a skill, in order of time."""
        return tuple(i for i, r in enumerate(self.records) if r.transition.instance.skill == skill)

    def skill_data(
        self, skill: str, predicates: Sequence[Predicate], truth: TruthSource
    ) -> SkillData:
        """The transitions of a skill as arrays, one table for each scene."""
        numbers = self.numbers_of(skill)
        tables = []
        for scene in self.scenes:
            mine = [i for i in numbers if self.records[i].scene == scene]
            if mine:
                space = AtomSpace(tuple(predicates), self.objects(scene))
                labels = truth.labels(space, self.observations(scene))
                tables.append(self._table(space, labels, mine))
        return tuple(tables)

    def _table(self, space: AtomSpace, labels: Labels, numbers: Sequence[int]) -> SkillTable:
        records = [self.records[i] for i in numbers]
        instances = tuple(sorted({r.transition.instance for r in records}))
        index = {instance: number for number, instance in enumerate(instances)}
        return SkillTable(
            space=space,
            instances=instances,
            which=np.array([index[r.transition.instance] for r in records], dtype=np.intp),
            success=np.array([r.transition.success for r in records], dtype=bool),
            before=labels[[r.before for r in records]],
            after=labels[[r.after for r in records]],
            ids=np.array(numbers, dtype=np.intp),
            unchanged=np.array(
                [r.transition.before.key == r.transition.after.key for r in records], dtype=bool
            ),
        )

    def _row(self, scene: Scene, observation: Observation) -> int:
        rows = self._rows.setdefault(scene, {})
        if observation.key not in rows:
            rows[observation.key] = len(rows)
            self._observations.setdefault(scene, []).append(observation)
        return rows[observation.key]

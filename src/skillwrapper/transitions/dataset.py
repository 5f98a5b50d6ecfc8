"""The data set: all transitions so far, and their pictures' labels as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.lifting import Lifter
from skillwrapper.transitions.tables import SkillData, SkillTable
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.types import Object


class TruthSource(Protocol):
    """Where labels come from; the learner knows nothing of models or prompts."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms) of the ground atoms; never asks twice for the same."""
        ...

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Announce what will be needed, so that it can be asked for at once."""
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
        self._numbers: dict[str, list[int]] = {}

    def __len__(self) -> int:
        return len(self.records)

    def add(self, episode: Episode) -> None:
        """Add the transitions of an episode."""
        for transition in episode.transitions:
            before = self._row(episode.scene, transition.before)
            # D11: only if the domain says so may a label be copied instead of read.
            copied = self.domain.failures_change_nothing and not transition.success
            after = before if copied else self._row(episode.scene, transition.after)
            self._numbers.setdefault(transition.instance.skill, []).append(len(self))
            self.records.append(Record(transition, episode.scene, before, after))

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes, in the order of their first episode."""
        return tuple(self._observations)

    def objects(self, scene: Scene) -> tuple[Object, ...]:
        """The objects of a scene."""
        return scene.objects

    def observations(self, scene: Scene) -> tuple[Observation, ...]:
        """The different observations of a scene, in order of time."""
        return tuple(self._observations[scene])

    def count_observations(self, scene: Scene) -> int:
        """How many different observations of a scene there are."""
        return len(self._observations[scene])

    def numbers_of(self, skill: str) -> tuple[int, ...]:
        """Numbers of the transitions of a skill, in order of time."""
        return tuple(self._numbers.get(skill, ()))

    def _row(self, scene: Scene, observation: Observation) -> int:
        rows = self._rows.setdefault(scene, {})
        if observation.key not in rows:
            rows[observation.key] = len(rows)
            self._observations.setdefault(scene, []).append(observation)
        return rows[observation.key]


class Reading:
    """A data set with the labels of its pictures, which are kept as arrays.

    Args:
        dataset: the transitions; may grow.
        truth: the labels of their pictures.
    """

    def __init__(self, dataset: Dataset, truth: TruthSource) -> None:
        self._dataset = dataset
        self._truth = truth
        self._spaces: dict[tuple[Scene, tuple[Predicate, ...]], AtomSpace] = {}
        self._labels: dict[tuple[Scene, Predicate], Labels] = {}
        self._lifter = Lifter()

    def space(self, scene: Scene, predicates: Sequence[Predicate]) -> AtomSpace:
        """The ground atoms of a vocabulary in a scene."""
        key = (scene, tuple(predicates))
        if key not in self._spaces:
            self._spaces[key] = AtomSpace(key[1], self._dataset.objects(scene))
        return self._spaces[key]

    def labels(self, scene: Scene, predicates: Sequence[Predicate]) -> Labels:
        """Labels (observations, atoms) of all observations of a scene."""
        number = self._dataset.count_observations(scene)
        missing = [p for p in predicates if len(self._labels.get((scene, p), ())) < number]
        if missing:
            self._read(scene, missing)
        blocks = [self._labels[scene, p] for p in predicates]
        return np.hstack(blocks) if blocks else np.zeros((number, 0), dtype=np.int8)

    def skill_data(self, skill: str, predicates: Sequence[Predicate]) -> SkillData:
        """The transitions of a skill as arrays, one table for each scene."""
        numbers = self._dataset.numbers_of(skill)
        tables = []
        for scene in self._dataset.scenes:
            mine = [i for i in numbers if self._dataset.records[i].scene == scene]
            if mine:
                labels = self.labels(scene, predicates)
                tables.append(self._table(self.space(scene, predicates), labels, mine))
        return tuple(tables)

    def forget_spaces(self) -> None:
        """Drop the ground atoms of vocabularies; labels are kept."""
        self._spaces.clear()

    def _read(self, scene: Scene, predicates: Sequence[Predicate]) -> None:
        space = self.space(scene, predicates)
        labels = self._truth.labels(space, self._dataset.observations(scene))
        first = 0
        for predicate in space.predicates:
            after = first + len(space.atoms_of[predicate.name])
            self._labels[scene, predicate] = labels[:, first:after]
            first = after

    def _table(self, space: AtomSpace, labels: Labels, numbers: Sequence[int]) -> SkillTable:
        records = [self._dataset.records[i] for i in numbers]
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
            lifter=self._lifter,
        )

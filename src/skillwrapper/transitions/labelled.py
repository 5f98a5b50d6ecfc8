"""Labelled transitions: the learner's only input (D17).

For every scene: which skills were run, and for every predicate the labels of its groundings in
all states, with a confidence each. They are values: what changes makes new ones, so whoever
learned from them can tell by their content what is left to be learned.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.errors import UnknownNameError
from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.executions import Executions
from skillwrapper.transitions.lifting import Lifter
from skillwrapper.transitions.tables import SkillData, SkillTable
from skillwrapper.world.domain import Domain

Confidence = NDArray[np.float32]

Content = tuple[tuple[bytes, tuple[tuple[Predicate, bytes], ...]], ...]
"""What a skill is learned from, scene by scene: its executions, and the labels around them."""


@dataclass(frozen=True, eq=False)
class PredicateLabels:
    """The labels of one predicate in all states of a scene.

    Attributes:
        predicate: the predicate.
        values: labels (states, groundings): TRUE, FALSE or UNKNOWN.
        confidence: the probability (states, groundings) that a label is right, 0.5 to 1.
    """

    predicate: Predicate
    values: Labels
    confidence: Confidence
    _digests: dict[bytes, bytes] = field(default_factory=dict, repr=False)
    _decided: dict[float, PredicateLabels] = field(default_factory=dict, repr=False)

    @classmethod
    def certain(cls, predicate: Predicate, values: Labels) -> PredicateLabels:
        """Labels without a doubt."""
        return cls(predicate, values, np.broadcast_to(np.float32(1.0), values.shape))

    @cached_property
    def known_values(self) -> frozenset[int]:
        """Which of TRUE and FALSE occur."""
        return frozenset(value for value in (TRUE, FALSE) if (self.values == value).any())

    @cached_property
    def is_certain(self) -> bool:
        """Whether no label is in doubt."""
        return not (self.confidence < 1).any()

    def decided(self, least: float) -> PredicateLabels:
        """Labels without a doubt: the same where the confidence suffices, all else UNKNOWN."""
        if self.is_certain:
            return self
        if least not in self._decided:
            doubtful = self.confidence < np.float32(least)
            values = np.where(doubtful, UNKNOWN, self.values).astype(np.int8)
            self._decided[least] = PredicateLabels.certain(self.predicate, values)
        return self._decided[least]

    def digest(self, executions: Executions) -> bytes:
        """Of the labels in the states before and after some executions."""
        key = executions.digest
        if key not in self._digests:
            digest = hashlib.blake2b(self.values[executions.states].tobytes(), digest_size=16)
            if not self.is_certain:
                digest.update(self.confidence[executions.states].tobytes())
            self._digests[key] = digest.digest()
        return self._digests[key]


def split_labels(
    space: AtomSpace, values: Labels, confidence: Confidence | None = None
) -> Iterator[PredicateLabels]:
    """The labels (states, atoms) of every predicate by itself; certain by default."""
    first = 0
    for predicate in space.predicates:
        own = slice(first, first + len(space.atoms_of[predicate.name]))
        if confidence is None:
            yield PredicateLabels.certain(predicate, values[:, own])
        else:
            yield PredicateLabels(predicate, values[:, own], confidence[:, own])
        first = own.stop


@dataclass(frozen=True, eq=False)
class SceneTransitions:
    """All transitions in one scene, with the labels of one vocabulary.

    Attributes:
        executions: what was run.
        labels: of every predicate, in the vocabulary's order.
    """

    executions: Executions
    labels: tuple[PredicateLabels, ...]

    @classmethod
    def of(
        cls,
        executions: Executions,
        space: AtomSpace,
        values: Labels,
        confidence: Confidence | None = None,
    ) -> SceneTransitions:
        """From the labels of all ground atoms.

        Args:
            executions: what was run.
            space: the ground atoms over the objects of the scene.
            values: labels (states, atoms).
            confidence: the probability (states, atoms) that a label is right; None for certain.
        """
        return cls(executions, tuple(split_labels(space, values, confidence)))

    @cached_property
    def space(self) -> AtomSpace:
        """The ground atoms of the vocabulary over the objects of the scene."""
        return AtomSpace(tuple(x.predicate for x in self.labels), self.executions.scene.objects)

    @cached_property
    def values(self) -> Labels:
        """The labels of all states (states, atoms)."""
        if not self.labels:
            return np.zeros((int(self.executions.states.max(initial=-1)) + 1, 0), dtype=np.int8)
        return np.hstack([x.values for x in self.labels])

    def table(self, skill: str, lifter: Lifter) -> SkillTable:
        """The transitions of one skill."""
        mine = self.executions.of_skill(skill)
        return SkillTable(
            space=self.space,
            instances=mine.instances,
            which=mine.which,
            success=mine.success,
            before=self.values[mine.before],
            after=self.values[mine.after],
            ids=mine.ids,
            unchanged=mine.unchanged,
            lifter=lifter,
        )

    def content(self, skill: str) -> tuple[bytes, tuple[tuple[Predicate, bytes], ...]]:
        """What the transitions of a skill are, as a value that can be compared."""
        mine = self.executions.of_skill(skill)
        return mine.digest, tuple((x.predicate, x.digest(mine)) for x in self.labels)


@dataclass(frozen=True, eq=False)
class LabelledTransitions:
    """All transitions, with the labels of one vocabulary.

    Attributes:
        domain: types and skills.
        predicates: the vocabulary; no two of one name.
        scenes: the transitions, scene by scene.
        lifter: lifts changes; shared, so that it remembers more.
    """

    domain: Domain
    predicates: tuple[Predicate, ...]
    scenes: tuple[SceneTransitions, ...]
    lifter: Lifter = field(default_factory=Lifter, repr=False)

    def __len__(self) -> int:
        return sum(len(scene.executions) for scene in self.scenes)

    def with_predicates(self, predicates: Iterable[Predicate]) -> LabelledTransitions:
        """The same with a part of the vocabulary.

        Raises:
            UnknownNameError: if a predicate is not labelled, with this meaning.
        """
        chosen = tuple(predicates)
        if chosen == self.predicates:
            return self
        known = {p: place for place, p in enumerate(self.predicates)}
        for predicate in chosen:
            if predicate not in known:
                names = (p.signature for p in self.predicates)
                raise UnknownNameError("labelled predicate", predicate.signature, names)
        places = [known[p] for p in chosen]
        scenes = (
            SceneTransitions(s.executions, tuple(s.labels[i] for i in places)) for s in self.scenes
        )
        return LabelledTransitions(self.domain, chosen, tuple(scenes), self.lifter)

    def decided(self, least: float) -> LabelledTransitions:
        """The same without doubts: UNKNOWN where the confidence is less than asked for."""
        if all(x.is_certain for s in self.scenes for x in s.labels):
            return self
        scenes = (
            SceneTransitions(s.executions, tuple(x.decided(least) for x in s.labels))
            for s in self.scenes
        )
        return LabelledTransitions(self.domain, self.predicates, tuple(scenes), self.lifter)

    @cached_property
    def varying(self) -> tuple[Predicate, ...]:
        """The predicates that are no tautologies: not all known labels are equal (D9)."""
        values: dict[Predicate, frozenset[int]] = dict.fromkeys(self.predicates, frozenset())
        for scene in self.scenes:
            for labels in scene.labels:
                values[labels.predicate] |= labels.known_values
        return tuple(p for p in self.predicates if len(values[p]) > 1)

    def of_skill(self, name: str) -> SkillData:
        """The transitions of one skill, one table for every scene in which it was run."""
        return tuple(
            scene.table(name, self.lifter)
            for scene in self.scenes
            if name in scene.executions.skills
        )

    def executions_of(self, skill: str) -> tuple[bytes, ...]:
        """What was run of a skill and with which outcome, as a value that can be compared."""
        return tuple(s.executions.of_skill(skill).digest for s in self.scenes)

    def content(self, skill: str) -> Content:
        """All that a skill is learned from, as a value that can be compared."""
        return tuple(
            scene.content(skill) for scene in self.scenes if skill in scene.executions.skills
        )

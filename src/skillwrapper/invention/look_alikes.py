"""Pictures that look alike to the vocabulary though other things were done before them (D26).

What tells them apart has no name yet: nothing that was tried so far needs it, but a goal may.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import UNKNOWN, AtomSpace
from skillwrapper.grounding.abstract_states import different_rows
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance

_ALIKE = 4
"""So many pictures that look alike to the vocabulary are compared with one another."""
_COMPARED = 200
"""Of more that look alike, the latest are paired: there are as many pairs as its square."""
_GROWTH = 1.5


class LookAlikes:
    """Chooses two pictures that look alike, before which the most other things were done.

    What was done before pictures that were shown already counts less. After some questions in vain
    the next one waits until half as much again was executed.

    Args:
        most: questions in vain in a row.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._in_vain = 0
        self._next = 0.0
        self._shown: Counter[SkillInstance] = Counter()
        self._asked: set[tuple[str, str]] = set()

    def next(self, labeller: Labeller, vocabulary: Sequence[Predicate]) -> Inconsistency | None:
        """What to ask about next; None if there is nothing, or it is too early.

        Args:
            labeller: holds the transitions, and labels their pictures.
            vocabulary: by which pictures look alike.
        """
        if not vocabulary or len(labeller.recorded) < self._next:
            return None
        deeds = _deeds(labeller.recorded)
        pairs = [
            pair for scene in labeller.recorded.scenes
            if (pair := self._best(labeller, vocabulary, scene, deeds)) is not None
        ]  # fmt: skip
        return max(pairs, key=lambda pair: pair[0])[1] if pairs else None

    def note(self, asked: Inconsistency, recorded: RecordedTransitions, *, in_vain: bool) -> None:
        """Take note of a question, and of whether no candidate was of use."""
        earlier, later = map(str, asked.identity[2])
        self._asked.add((earlier, later))
        deeds = _deeds(recorded)
        self._shown.update(deeds[earlier] ^ deeds[later])
        self._in_vain = self._in_vain + 1 if in_vain else 0
        if in_vain and self._in_vain % self._most == 0:
            self._next = _GROWTH * len(recorded)

    def _best(
        self,
        labeller: Labeller,
        vocabulary: Sequence[Predicate],
        scene: Scene,
        deeds: Deeds,
    ) -> tuple[float, Inconsistency] | None:
        """The pair of a scene with the most other things done before, and how much that is."""
        observations = labeller.recorded.observations(scene)
        done = [deeds[o.key] for o in observations]
        skills = sorted(frozenset().union(*done))
        did = np.array([[i in own for i in skills] for own in done], dtype=np.float64)
        did = did.reshape(len(done), len(skills))
        weight = np.array([1 / (1 + self._shown[i]) for i in skills])
        first, last = _moments(labeller.recorded, scene)
        best: tuple[float, Inconsistency] | None = None
        for members in _alike(labeller.values(scene, vocabulary)):
            own = did[members]
            total = own @ weight
            value = total[:, np.newaxis] + total - 2 * (own * weight) @ own.T
            for a, b in _pairs(value):
                one, other = int(members[a]), int(members[b])
                if best is not None and value[a, b] <= best[0]:
                    break
                keys = observations[one].key, observations[other].key
                are_told = one in first and other in last and first[one] < last[other]
                if are_told and value[a, b] > 0 and keys not in self._asked:
                    asked = _question(labeller.recorded, first[one], last[other], keys)
                    best = float(value[a, b]), asked
                    break
        return best


Deeds = dict[str, frozenset[SkillInstance]]
"""For every picture, by its key, what had succeeded in the episode by then."""


def _alike(states: NDArray[np.int8]) -> Iterator[NDArray[np.intp]]:
    """Places of the latest pictures (pictures, atoms) that look alike, for each look of several."""
    _, place = different_rows(states)
    for number in np.flatnonzero(np.bincount(place) > 1):
        yield np.flatnonzero(place == number)[-_COMPARED:]


def _pairs(value: NDArray[np.float64]) -> Iterator[tuple[int, int]]:
    """Pairs of pictures, an earlier one and a later one, in the order of their values, falling."""
    first, second = np.triu_indices(len(value), k=1)
    order = np.argsort(-value[first, second], kind="stable")
    yield from zip(first[order].tolist(), second[order].tolist(), strict=True)


def _moments(recorded: RecordedTransitions, scene: Scene) -> tuple[dict[int, int], dict[int, int]]:
    """The transitions before which, and the successes after which, pictures were taken."""
    first: dict[int, int] = {}
    last: dict[int, int] = {}
    for number, record in enumerate(recorded.records):
        if record.scene == scene:
            first.setdefault(record.before, number)
            if record.transition.success:
                last.setdefault(record.after, number)
    return first, last


def _question(
    recorded: RecordedTransitions, first: int, last: int, keys: tuple[str, str]
) -> Inconsistency:
    kind, skill = InconsistencyKind.UNNOTICED, recorded.records[last].transition.instance.skill
    identity = skill, kind, keys, ()
    return Inconsistency(
        kind,
        skill,
        first=last,
        second=None,
        culprit=last,
        identity=identity,
        wide=True,
        since=first,
    )


def look_alikes(
    labeller: Labeller, vocabulary: Sequence[Predicate], asked: Inconsistency
) -> tuple[Scene, tuple[Observation, ...]]:
    """The pictures before and after a success, and those that are alike to the vocabulary."""
    scene, groups = _groups(labeller, vocabulary, asked)
    return scene, tuple(dict.fromkeys(o for group in groups for o in group))


def tells_more(
    labeller: Labeller,
    vocabulary: Sequence[Predicate],
    asked: Inconsistency,
    candidates: Sequence[Predicate],
) -> set[Predicate]:
    """The candidates that tell pictures apart which are alike to the vocabulary.

    They are looked for among those that look like the ones before and after the success.
    """
    scene, groups = _groups(labeller, vocabulary, asked)
    seen = [o for group in groups for o in group]
    labeller.truth.prefetch((AtomSpace((p,), scene.objects), seen) for p in candidates)
    telling = set()
    for predicate in candidates:
        space = AtomSpace((predicate,), scene.objects)
        for group in groups:
            labels = labeller.truth.labels(space, group)
            known = (labels != UNKNOWN).all(axis=0)
            if (labels[:, known] != labels[0, known]).any():
                telling.add(predicate)
    return telling


def _groups(
    labeller: Labeller, vocabulary: Sequence[Predicate], asked: Inconsistency
) -> tuple[Scene, list[list[Observation]]]:
    """Pictures that look like the one before the success, and like the one after it.

    Those first before which the most other things were done in their episodes.
    """
    records = labeller.recorded.records
    record = records[asked.culprit]
    earlier = record if asked.since is None else records[asked.since]
    observations = labeller.recorded.observations(record.scene)
    states = labeller.values(record.scene, vocabulary)
    deeds = _deeds(labeller.recorded)
    groups = []
    for place in dict.fromkeys((earlier.before, record.after)):
        same = np.flatnonzero((states == states[place]).all(axis=1)).tolist()
        own = deeds[observations[place].key]
        unlike = sorted(
            (n for n in same if n != place),
            key=lambda n: len(own ^ deeds[observations[n].key]),
            reverse=True,
        )[:_ALIKE]
        groups.append([observations[n] for n in (place, *unlike)])
    return record.scene, groups


def _deeds(recorded: RecordedTransitions) -> Deeds:
    """For every picture, by its key, what had succeeded in the episode by then."""
    found: Deeds = {}
    for record in recorded.records:
        transition = record.transition
        before = found.setdefault(transition.before.key, frozenset())
        done = before | {transition.instance} if transition.success else before
        found.setdefault(transition.after.key, done)
    return found

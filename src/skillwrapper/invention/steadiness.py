"""Steadiness: where the state is the same, a predicate of the state says the same (D8).

What reads otherwise tells of the picture: of where the robot happens to stand or of the light. The
state is the same at all starts where a reset brings it back, and before and after an execution that
is known to have changed nothing. Of other failures it is not known; but they hardly ever change
what has nothing to do with the skill, and not as often as successes do.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

_DECISIVE = math.log(100)
"""A hundred to one, the usual mark of decisive evidence (Jeffreys)."""
_PAIRS = 12
"""The state around so many of the latest executions is compared."""
_SKILLS = 2
"""What failures change is a matter of their skill; not what changes around failures of so many."""
_RARELY = 0.01
"""The share of failures that change what has nothing to do with them."""
_OF_OTHERS = 0.05
"""The share of its readings that is expected to be wrong of a predicate at large. What is seldom
misread is taken into use first, and tells little of others: of the eight predicates that GPT-5 was
measured on, the shares are 0 to .2, and .046 in the mean, though .025 of all readings are wrong."""


class Steadiness:
    """Compares what predicates say of pictures of the same state, scene by scene.

    Args:
        labeller: holds the transitions, and labels their pictures.
        tolerance: the share of starts, 0 to 0.5, that may be read otherwise by mistake.
    """

    def __init__(self, labeller: Labeller, tolerance: float = 0.0) -> None:
        self._labeller = labeller
        self._recorded, self._truth = labeller.recorded, labeller.truth
        self._tolerance = tolerance
        self._starts: dict[Scene, dict[str, Observation]] = {}

    @cached_property
    def _everywhere(self) -> frozenset[str]:
        """The objects that are arguments of all skill instances, like the robot perhaps."""
        arguments = [set(i.arguments) for i in self._recorded.domain.skill_instances]
        return frozenset(set.intersection(*arguments)) if arguments else frozenset()

    def note(self, scene: Scene, start: Observation) -> None:
        """Take note of what was seen right after a reset."""
        if self._recorded.domain.resets_restore_state:
            self._starts.setdefault(scene, {}).setdefault(start.key, start)

    def unsteady(self, predicates: Iterable[Predicate]) -> tuple[Predicate, ...]:
        """Those that say different things of the same state."""
        chosen = tuple(predicates)
        self._truth.prefetch(
            (AtomSpace((p,), scene.objects), pictures)
            for scene, pictures in self.pictures()
            for p in chosen
        )
        starts, around = self._compared_starts(), self._latest(success=False)
        return tuple(
            p
            for p in chosen
            if any(self._varies(p, s, o) for s, o in starts) or self._flickers(p, around)
        )

    def pictures(self) -> list[tuple[Scene, tuple[Observation, ...]]]:
        """What is looked at first, scene by scene."""
        around = self._latest(success=False)
        return [*self._compared_starts(), *((r.scene, _pictures(r)) for r in around)]

    def _compared_starts(self) -> list[tuple[Scene, tuple[Observation, ...]]]:
        return [(s, tuple(o.values())) for s, o in self._starts.items() if len(o) > 1]

    def _latest(self, *, success: bool) -> list[RecordedTransition]:
        """The latest executions around which another picture was taken."""
        found = [
            record
            for record in self._recorded.records
            if record.transition.success is success
            and record.transition.before.key != record.transition.after.key
        ]
        return found[-_PAIRS:]

    def _varies(self, predicate: Predicate, scene: Scene, starts: Sequence[Observation]) -> bool:
        labels = self._truth.labels(AtomSpace((predicate,), scene.objects), starts)
        true, false = (labels == TRUE).sum(axis=0), (labels == FALSE).sum(axis=0)
        fewer = np.minimum(true, false)
        misread = self._labeller.misread
        if misread:
            mean = max(misread, _OF_OTHERS)
            return varies_in_truth(fewer.tolist(), (true + false).tolist(), mean)
        return bool((fewer > self._tolerance * len(starts)).any())

    def _flickers(self, predicate: Predicate, around: Sequence[RecordedTransition]) -> bool:
        """Whether a predicate changes around failures as if it had nothing to do with the state."""
        misread = self._labeller.misread
        failures = [self._changed(predicate, record) for record in around]
        if not misread and not self._tolerance:
            known = (c for c, record in zip(failures, around, strict=True) if record.unchanged)
            if any(changed.any() for changed, _ in known):
                return True
        strange = [bool(changed[own].any()) for changed, own in failures if own.any()]
        changed = [bool(changed.any()) for changed, _ in failures]
        skills = {r.transition.instance.skill for r, c in zip(around, changed, strict=True) if c}
        for seen in (strange, changed if len(skills) >= _SKILLS else []):
            if varies_in_truth([sum(seen)], [len(seen)], max(misread, _RARELY)):
                done = [self._changed(predicate, r)[0].any() for r in self._latest(success=True)]
                return bool(2 * sum(changed) * len(done) >= sum(done) * len(changed))
        return False

    def _changed(
        self, predicate: Predicate, record: RecordedTransition
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which atoms (atoms,) change around an execution, and which it should not touch.

        These are the ones of no argument, but for the arguments that all skills have.
        """
        space = AtomSpace((predicate,), record.scene.objects)
        labels = self._truth.labels(space, _pictures(record))
        changed = (labels[0] != labels[1]) & (labels != UNKNOWN).all(axis=0)
        touched = set(record.transition.instance.arguments) - self._everywhere
        strange = np.array([not touched & set(atom.terms) for atom in space.atoms], dtype=bool)
        return changed, strange


def _pictures(record: RecordedTransition) -> tuple[Observation, Observation]:
    return record.transition.before, record.transition.after


def varies_in_truth(fewer: Sequence[int], read: Sequence[int], misread: float) -> bool:
    """Whether atoms that should be the same at every start vary more than by misreading.

    Compares for each atom the marginal likelihoods of its minority being misreadings at an unknown
    rate of the given mean (Beta, worth half an error), and of it being a share of any size.

    Args:
        fewer: for each atom at how many starts it is read otherwise than at most.
        read: for each atom at how many starts it is read.
        misread: the share of readings that is expected to be wrong.
    """
    weight = 0.5 / misread - 0.5
    evidence = 0.0
    for k, n in zip(fewer, read, strict=True):
        if k:
            varying = _log_beta(k + 1, n - k + 1)
            misreading = _log_beta(k + 0.5, n - k + weight) - _log_beta(0.5, weight)
            evidence += max(0.0, varying - misreading)
    return evidence > _DECISIVE


def _log_beta(one: float, other: float) -> float:
    return math.lgamma(one) + math.lgamma(other) - math.lgamma(one + other)

"""Steadiness: where a reset brings the same state back, a predicate of the state says the same.

What reads otherwise at another start tells of the picture, of where the robot happens to stand or
of the light, and not of the state (D8).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, AtomSpace
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Predicate
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

_DECISIVE = math.log(100)
"""A hundred to one, the usual mark of decisive evidence (Jeffreys)."""


class Steadiness:
    """Compares what predicates say of the starts of episodes, scene by scene.

    Args:
        truth: the labels of pictures.
        tolerance: the share of starts, 0 to 0.5, that may be read otherwise by mistake.
        misread: tells the share of readings that is now expected to be wrong; if it is not 0, a
            predicate varies only if that explains its readings better than misreading does.
    """

    def __init__(
        self,
        truth: TruthSource,
        tolerance: float = 0.0,
        misread: Callable[[], float] = lambda: 0.0,
    ) -> None:
        self._truth = truth
        self._misread = misread
        self._tolerance = tolerance
        self._starts: dict[Scene, dict[str, Observation]] = {}

    def note(self, scene: Scene, start: Observation) -> bool:
        """Take note of what was seen right after a reset; whether it was not seen before."""
        known = self._starts.setdefault(scene, {})
        is_new = start.key not in known
        known.setdefault(start.key, start)
        return is_new

    def unsteady(self, predicates: Iterable[Predicate]) -> tuple[Predicate, ...]:
        """Those that say different things of starts."""
        chosen = tuple(predicates)
        scenes = {s: tuple(o.values()) for s, o in self._starts.items() if len(o) > 1}
        if not chosen or not scenes:
            return ()
        self._truth.prefetch(
            (AtomSpace((p,), scene.objects), starts)
            for scene, starts in scenes.items()
            for p in chosen
        )
        return tuple(p for p in chosen if any(self._varies(p, s, o) for s, o in scenes.items()))

    def _varies(self, predicate: Predicate, scene: Scene, starts: Sequence[Observation]) -> bool:
        labels = self._truth.labels(AtomSpace((predicate,), scene.objects), starts)
        true, false = (labels == TRUE).sum(axis=0), (labels == FALSE).sum(axis=0)
        fewer = np.minimum(true, false)
        misread = self._misread()
        if misread:
            return varies_in_truth(fewer.tolist(), (true + false).tolist(), misread)
        return bool((fewer > self._tolerance * len(starts)).any())


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

"""Steadiness: where a reset brings the same state back, a predicate of the state says the same.

What reads otherwise at another start tells of the picture, of where the robot happens to stand or
of the light, and not of the state (D8).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, AtomSpace
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Predicate
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


class Steadiness:
    """Compares what predicates say of the starts of episodes, scene by scene.

    Args:
        truth: the labels of pictures.
        tolerance: the share of starts, 0 to 0.5, that may be read otherwise by mistake.
    """

    def __init__(self, truth: TruthSource, tolerance: float = 0.0) -> None:
        self._truth = truth
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
        fewer = np.minimum((labels == TRUE).sum(axis=0), (labels == FALSE).sum(axis=0))
        return bool((fewer > self._tolerance * len(starts)).any())

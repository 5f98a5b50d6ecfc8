"""What a run read off its pictures, as a source of labels that asks nobody."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.runs.archive.labels import RecordedLabels
from skillwrapper.world.observation import Observation

_CODES = {True: TRUE, False: FALSE, None: UNKNOWN}


class RecordedReadings:
    """Readings of the final vocabulary (``perception.labelling.TruthSource``).

    Args:
        labels: what was read; what is not among it is unknown.
    """

    def __init__(self, labels: RecordedLabels) -> None:
        self._labels = labels

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing to do: all is there."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms)."""
        names = [str(atom) for atom in space.atoms]
        rows = [self._labels.of(observation.key) for observation in observations]
        codes = [[_CODES[row.get(name)] for name in names] for row in rows]
        return np.array(codes, dtype=np.int8).reshape(len(observations), len(names))

"""What pictures taken after resets tell of a world, and of the eyes that read them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from garden import GARDEN, OPEN

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.world import Observation, Picture

SCENE = GARDEN.scene()


class Reader:
    """Reads pictures that have labels written on them."""

    def prefetch(self, wanted: Iterable[object]) -> None:
        pass

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        rows = [[int(c) for c in o.pictures[0].png.decode()[:2]] for o in observations]
        return np.array(rows, dtype=np.int8).reshape(len(rows), 2)


def acquainted(*written: str) -> Acquaintance:
    seen = [Observation((Picture(f"{text} {n}".encode()),)) for n, text in enumerate(written)]
    return Acquaintance.from_starts({SCENE: seen}, Reader(), (OPEN,), restored=True)


def test_one_misread_start_is_outvoted() -> None:
    found = acquainted("10", "10", "11", "10", "10")
    assert found.familiar[SCENE].labels.tolist() == [[1, 0]]


def test_what_cannot_be_told_is_taken_both_ways() -> None:
    found = acquainted("10", "11")
    assert sorted(found.familiar[SCENE].labels.tolist()) == [[1, 0], [1, 1]]
    assert np.isclose(np.exp(found.familiar[SCENE].nats).sum(), 1.0, atol=0.01)

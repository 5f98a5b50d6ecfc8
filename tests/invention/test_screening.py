"""Candidates are turned away by what pictures show, not by what is misread in one of them (D24)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from misread_kitchen import VOCABULARY, MisreadKitchen

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.invention.screening import ALIKE, Screen
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.steadiness import Steadiness
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.robust import RobustLearner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.world import Observation

IS_CUT = next(p for p in VOCABULARY if p.name == "is_cut")
HAND_EMPTY = next(p for p in VOCABULARY if p.name == "hand_empty")
KNOWN = tuple(p for p in VOCABULARY if p != IS_CUT)
SETTINGS = LearningSettings(steady=False)


class _Dazzled(MisreadKitchen):
    """What is cut is misread in some pictures."""

    misread: frozenset[str] = frozenset()

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        read = super().labels(space, observations)
        rows = [row for row, one in enumerate(observations) if one.key in self.misread]
        columns = [c for a, c in space.column.items() if a.predicate == IS_CUT.name]
        read[np.ix_(rows, columns)] = 1 - read[np.ix_(rows, columns)]
        return read


@pytest.fixture(scope="module")
def seen() -> tuple[_Dazzled, Inconsistency]:
    """A Cut that seems to change nothing, misread right after it worked."""
    kitchen = _Dazzled(150, seed=1)
    labels = DecodedLabeller(kitchen.recorded, kitchen, lambda: KNOWN).label(KNOWN)
    found = RobustLearner().learn(labels).skill("Cut").unnoticed
    assert found is not None
    failed = next(n for n, r in enumerate(kitchen.recorded.records)
                  if r.transition.instance.skill == "Cut" and not r.transition.success)  # fmt: skip
    (first, *_) = found.partners
    pair = Inconsistency(
        InconsistencyKind.EFFECT, "Cut", first, failed, failed, ("Cut", found.kind, (), ())
    )
    kitchen.misread = frozenset({kitchen.recorded.records[first].transition.after.key})
    return kitchen, pair


def _flaws(labeller: Labeller, pair: Inconsistency, *candidates: Predicate) -> list[str]:
    screen = Screen(labeller, Steadiness(labeller), SETTINGS)
    return [flaw for _, flaw in screen.flaws(pair, candidates, KNOWN)]


def test_what_is_misread_in_one_picture_is_seen_by_those_around(
    seen: tuple[_Dazzled, Inconsistency],
) -> None:
    kitchen, pair = seen
    assert _flaws(Labeller(kitchen.recorded, kitchen), pair, IS_CUT) == [ALIKE]
    decoded = DecodedLabeller(kitchen.recorded, kitchen, lambda: KNOWN)
    assert _flaws(decoded, pair, IS_CUT) == [""]


def test_what_truly_looks_alike_is_turned_away(seen: tuple[_Dazzled, Inconsistency]) -> None:
    kitchen, pair = seen
    decoded = DecodedLabeller(kitchen.recorded, kitchen, lambda: KNOWN)
    assert _flaws(decoded, pair, HAND_EMPTY) == [ALIKE]

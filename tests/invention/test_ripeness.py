"""Suspected misreadings are not asked about; what is seen clearly or often is."""

from __future__ import annotations

from dataclasses import replace

import pytest
from barn import FULL, HELD, ON, barn

from skillwrapper.invention.ripeness import Ripeness
from skillwrapper.invention.steadiness import varies_in_truth
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.perception.labelling import Labeller

USED = (FULL, ON, HELD)


class _Doubting(Labeller):
    doubts: dict[int, float]
    misread_share = 0.0

    @property
    def misread(self) -> float:
        return self.misread_share

    def doubt(self, number: int) -> float:
        return self.doubts.get(number, 0.9)


def _found(pictures: int, doubts: dict[int, float]) -> tuple[Ripeness, list[Inconsistency]]:
    book = barn(*[f"full(h) #{n}" for n in range(pictures)])
    labeller = _Doubting(book.recorded, book)
    labeller.doubts = doubts
    (first, *_) = barn(*["#9"]).fit(HELD).inconsistencies
    failures = [n for n, r in enumerate(book.recorded.records) if not r.transition.success]
    return Ripeness(labeller), [replace(first, culprit=n) for n in failures]


def test_what_a_misreading_explains_waits() -> None:
    ripeness, found = _found(2, {})
    assert ripeness.ripe(found, USED) == ()
    assert len(ripeness.ripe(found, USED[:2])) == 2, "too few predicates to tell"


def test_what_was_seen_clearly_is_ripe_and_comes_first() -> None:
    ripeness, found = _found(2, {3: 0.1})
    assert [one.culprit for one in ripeness.ripe(found, USED)] == [3, 2]


def test_what_was_seen_often_is_ripe() -> None:
    ripeness, found = _found(4, {})
    assert len(ripeness.ripe(found, USED)) == 4


def test_what_has_just_come_up_waits_for_further_pictures() -> None:
    book = barn("#0", "full(h) #0")
    labeller = _Doubting(book.recorded, book)
    labeller.doubts, labeller.misread_share = {2: 0.1}, 0.02
    (one, *_) = book.fit(HELD).inconsistencies
    ripeness, found = Ripeness(labeller), [replace(one, culprit=2)]
    ripeness.leave([])
    ripeness.look(found)
    ripeness.leave(found)
    assert ripeness.ripe(found, USED) == ()
    assert ripeness.ripe(found, USED[:2]), "nothing can tell yet what is misread"
    for number in range(2):
        book.failure(f"full(h) #{number + 7}", "Lift(h, a)")
    ripeness.look(found)
    assert ripeness.ripe(found, USED)


def test_what_another_vocabulary_brings_up_need_not_wait() -> None:
    book = barn("#0")
    labeller = _Doubting(book.recorded, book)
    labeller.doubts, labeller.misread_share = {2: 0.1}, 0.02
    (one, *_) = book.fit(HELD).inconsistencies
    ripeness = Ripeness(labeller)
    ripeness.look([])
    assert ripeness.ripe([replace(one, culprit=2)], USED)


@pytest.mark.parametrize(
    ("fewer", "read", "varies"), [([1], [10], False), ([5], [10], True), ([0, 0], [9, 9], False)]
)
def test_steadiness_allows_for_misreading(fewer: list[int], read: list[int], varies: bool) -> None:
    assert varies_in_truth(fewer, read, 0.025) is varies

"""Rejections are remembered for what they were of (D8)."""

from __future__ import annotations

from skillwrapper.invention.rejections import Rejections
from skillwrapper.learning.inconsistencies import Identity
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate

A, B = Predicate("a", ()), Predicate("b", ())
TAKE: Identity = ("Take", InconsistencyKind.EFFECT, (), ())
WAVE: Identity = ("Wave", InconsistencyKind.EFFECT, (), ())


def test_of_one_cause_only() -> None:
    rejections = Rejections()
    rejections.reject(A, TAKE)
    assert rejections.of(TAKE) == (A,)
    assert rejections.of(WAVE) == ()


def test_of_all_causes_where_that_is_asked_for() -> None:
    rejections = Rejections(by_cause=False)
    rejections.reject(A, TAKE)
    assert rejections.of(WAVE) == (A,)


def test_new_data_of_the_skill_let_them_lapse() -> None:
    rejections = Rejections()
    rejections.reject(A, TAKE)
    rejections.reject(B, WAVE)
    rejections.admit_data_of(["Take"])
    assert rejections.of(TAKE) == ()
    assert rejections.of(WAVE) == (B,)


def test_what_was_taken_back_may_come_again_with_new_data_and_what_is_banned_may_not() -> None:
    rejections = Rejections()
    rejections.retract([A])
    rejections.ban([B])
    assert set(rejections.of(TAKE)) == {A, B}
    rejections.admit_data_of([])
    assert set(rejections.of(TAKE)) == {A, B}
    rejections.admit_data_of(["Wave"])
    assert rejections.of(TAKE) == (B,)

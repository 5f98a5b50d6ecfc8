"""Attempts at what never succeeded: what no failure rules out."""

from __future__ import annotations

import numpy as np

from skillwrapper.exploration.promise import promise_of


def features(*rows: str) -> np.ndarray:
    """From ``"110"``: what holds, then what does not."""
    holds = np.array([[mark == "1" for mark in row] for row in rows], dtype=bool)
    return np.hstack([holds, ~holds])


def test_what_failed_just_so_promises_nothing() -> None:
    assert promise_of(features("110"), features("110", "011")).tolist() == [0.0]


def test_before_the_first_failure_everything_is_promising() -> None:
    nothing = np.zeros((0, 6), dtype=bool)
    assert (promise_of(features("110", "001"), nothing) > 0).all()


def test_something_never_seen_promises_more_than_a_new_combination() -> None:
    failed = features("1000", "0100", "0010")
    single, pair = promise_of(features("0001", "1100"), failed)
    assert single > pair > 0


def test_a_new_whole_of_known_parts_still_promises_something() -> None:
    failed = features("1110", "1101", "1011", "0111")
    whole, known = promise_of(features("1111", "1110"), failed)
    assert whole > known == 0.0

"""The kinds of inconsistency."""

from __future__ import annotations

from enum import StrEnum


class InconsistencyKind(StrEnum):
    """Why a predicate is missing.

    PRECONDITION: a success and a failure are both predicted to succeed (paper, Condition 1).
    EFFECT: a success and a failure made the same change (paper, Condition 2).
    DETERMINISM: an applicable operator predicts another change than was seen (D5).
    UNEXPLAINED: something changed that is connected to no argument (D1).
    UNNOTICED: all successes of a skill change nothing in the vocabulary (D26). Unlike the others
        it may be as it should be, so it is no inconsistency until somebody sees a change.
    """

    PRECONDITION = "precondition"
    EFFECT = "effect"
    DETERMINISM = "determinism"
    UNEXPLAINED = "unexplained"
    UNNOTICED = "unnoticed"


INCONSISTENT = tuple(k for k in InconsistencyKind if k is not InconsistencyKind.UNNOTICED)
"""The kinds of which one is always wrong."""

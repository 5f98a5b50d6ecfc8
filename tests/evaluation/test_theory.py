"""Bounds: against figures worked out otherwise, and on whole runs."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillwrapper.evaluation.theory.hypotheses import HypothesisClass, sample_size
from skillwrapper.evaluation.theory.intervals import at_most, clopper_pearson

SMALL = HypothesisClass(predicates=2, arity=1, objects=2, skills=1, operators=1)


def test_the_size_of_a_small_class() -> None:
    assert float(SMALL.log_size) == pytest.approx(4 * math.log(3))


def test_the_papers_own_bound_on_operators() -> None:
    paper = HypothesisClass(predicates=2, arity=1, objects=2, skills=1)
    assert float(paper.log_size) == pytest.approx(4 * 3**4 * math.log(3))


@given(st.floats(0.01, 0.5), st.floats(0.01, 0.5))
def test_so_many_blocks_suffice_and_fewer_do_not(epsilon: float, delta: float) -> None:
    blocks = 10 ** float(sample_size(SMALL, epsilon, delta).log10_blocks)
    size = math.exp(float(SMALL.log_size))
    assert size * math.exp(-blocks * epsilon) == pytest.approx(delta / 2)


def test_mixing_costs_a_lag() -> None:
    alone, mixed = sample_size(SMALL, 0.1, 0.1), sample_size(SMALL, 0.1, 0.1, mixing=0.5)
    lag = 10 ** float(mixed.log10_lag)
    blocks = 10 ** float(mixed.log10_blocks)
    penalty = math.exp(float(SMALL.log_size)) * blocks * math.exp(-0.5 * lag)
    assert penalty == pytest.approx(0.05)
    assert mixed.log10_transitions > alone.log10_transitions


@pytest.mark.parametrize(
    ("wrong", "tried", "lower", "upper"),
    [(0, 10, 0.0, 0.3085), (1, 10, 0.0025, 0.4450), (5, 10, 0.1871, 0.8129), (10, 10, 0.6915, 1.0)],
)
def test_known_intervals(wrong: int, tried: int, lower: float, upper: float) -> None:
    assert clopper_pearson(wrong, tried) == pytest.approx((lower, upper), abs=1e-4)


@pytest.mark.parametrize("share", [0.02, 0.3])
def test_the_interval_holds_the_truth_as_often_as_it_says(share: float) -> None:
    tried, held = 40, 0.0
    for wrong in range(tried + 1):
        low, high = clopper_pearson(wrong, tried, 0.9)
        before = at_most(wrong - 1, tried, share) if wrong else 0.0
        if low <= share <= high:
            held += at_most(wrong, tried, share) - before
    assert held >= 0.9

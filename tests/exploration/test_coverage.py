"""Coverage: pairs of skills and the entropy gained by trying them (paper, Algorithm 3)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from garden import GARDEN, OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT, SHUT_RIGHT
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from skillwrapper.exploration.scores import PairCounts, entropy
from skillwrapper.world import SkillInstance

INSTANCES = GARDEN.skill_instances
QUICK = settings(max_examples=60, deadline=None, derandomize=True)
COUNTS = arrays(np.int64, (3, 3), elements=st.integers(0, 20))
SEQUENCES = st.lists(st.sampled_from(INSTANCES), max_size=12)


@QUICK
@given(COUNTS, st.permutations(range(9)), st.integers(1, 5))
def test_entropy_is_of_the_distribution(counts, order, factor) -> None:
    value = entropy(counts)
    assert 0 <= value <= math.log(9) + 1e-9
    assert entropy(counts.ravel()[list(order)].reshape(3, 3)) == pytest.approx(value)
    assert entropy(counts * factor) == pytest.approx(value)


@QUICK
@given(COUNTS)
def test_evening_out_never_lowers_the_entropy(counts) -> None:
    flat = np.sort(counts.ravel())
    if flat[-1] - flat[0] >= 2:
        evened = flat.copy()
        evened[0], evened[-1] = flat[0] + 1, flat[-1] - 1
        assert entropy(evened) > entropy(flat)


def test_entropy_of_known_distributions() -> None:
    assert entropy(np.zeros((2, 2), dtype=np.int64)) == 0
    assert entropy(np.array([[7, 0], [0, 0]])) == 0
    assert entropy(np.full((2, 2), 5)) == pytest.approx(math.log(4))
    assert entropy(np.array([[1, 3], [0, 0]])) == pytest.approx(
        -(0.25 * math.log(0.25) + 0.75 * math.log(0.75))
    )


@QUICK
@given(SEQUENCES, SEQUENCES)
def test_gain_is_the_difference_that_executing_makes(done, planned) -> None:
    pairs = PairCounts(INSTANCES)
    pairs.add(done)
    before, gain = entropy(pairs.counts), pairs.gain(planned)
    assert entropy(pairs.counts) == before
    pairs.add(planned)
    assert entropy(pairs.counts) - before == pytest.approx(gain)


def test_new_pairs_gain_most() -> None:
    pairs = PairCounts(INSTANCES)
    pairs.add([OPEN_LEFT, SHUT_LEFT, OPEN_LEFT, SHUT_LEFT])
    again = pairs.gain([OPEN_LEFT, SHUT_LEFT])
    new = pairs.gain([OPEN_RIGHT, SHUT_RIGHT])
    assert again < 0 < new


def test_pairs_are_consecutive_and_end_with_the_episode() -> None:
    pairs = PairCounts(INSTANCES)
    pairs.add([OPEN_LEFT, SHUT_LEFT])
    pairs.add([OPEN_RIGHT])
    assert pairs.counts.sum() == 1
    assert pairs.counts[0, 2] == 1
    assert pairs.share_covered() == 1 / 16


def test_pairs_of_skills() -> None:
    """D16: the option of counting skills instead of their instances."""
    pairs = PairCounts(INSTANCES, lifted=True)
    pairs.add([OPEN_LEFT, SHUT_LEFT, OPEN_RIGHT])
    assert pairs.counts.tolist() == [[0, 1], [1, 0]]
    assert pairs.gain([OPEN_RIGHT, SHUT_RIGHT]) < 0
    assert pairs.share_covered() == 0.5


def test_without_instances() -> None:
    nothing: tuple[SkillInstance, ...] = ()
    assert PairCounts(nothing).share_covered() == 1

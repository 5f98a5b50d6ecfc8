from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillwrapper.exploration.scores import pareto_set

SCORES = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1, max_size=8)
QUICK = settings(max_examples=100, deadline=None, derandomize=True)


def beats(one: tuple[int, int], other: tuple[int, int]) -> bool:
    return one[0] >= other[0] and one[1] >= other[1] and one != other


@QUICK
@given(SCORES)
def test_laws(scores) -> None:
    """Someone is in; who is in is beaten by none; who is out is beaten by one who is in."""
    chosen = pareto_set(scores)
    assert chosen
    assert list(chosen) == sorted(set(chosen))
    for i, own in enumerate(scores):
        beaten = any(beats(scores[j], own) for j in chosen)
        assert beaten == (i not in chosen)


@QUICK
@given(SCORES, st.randoms())
def test_order_does_not_matter(scores, random) -> None:
    shuffled = scores[:]
    random.shuffle(shuffled)
    assert sorted(scores[i] for i in pareto_set(scores)) == sorted(
        shuffled[i] for i in pareto_set(shuffled)
    )


@pytest.mark.parametrize(
    ("scores", "chosen"),
    [
        ([(1.0, 1.0), (1.0, 1.0)], (0, 1)),
        ([(1.0, 1.0), (1.0, 1.0), (1.0, 0.5)], (0, 1)),
        ([(1.0, 0.0), (0.0, 1.0), (0.5, 0.5)], (0, 1, 2)),
        ([(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)], (2,)),
        ([(-0.1, 0.2)], (0,)),
    ],
)
def test_exact_ties_all_stay(scores, chosen) -> None:
    """D16: as the paper writes it, two equal candidates would throw each other out."""
    assert pareto_set(scores) == chosen

"""Repairs: every sequence becomes one that can be run, and what was changed is said."""

from __future__ import annotations

from collections import Counter

import numpy as np
from garden import GARDEN, OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT, SHUT_RIGHT, is_repetitive
from hypothesis import given, settings
from hypothesis import strategies as st

from skillwrapper.exploration.proposed import random_sequence, repair_sequence
from skillwrapper.world import SkillInstance

ALLOWED = (OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT)
QUICK = settings(max_examples=100, deadline=None, derandomize=True)
SEQUENCES = st.lists(st.sampled_from(GARDEN.skill_instances), max_size=12)


@QUICK
@given(SEQUENCES, st.integers(1, 8), st.integers(0, 99))
def test_laws(sequence, length, seed) -> None:
    """Right length, allowed, no repetition, the given order kept; a note for each change."""
    repaired, notes = repair_sequence(sequence, ALLOWED, length, np.random.default_rng(seed))
    assert len(repaired) == length
    assert set(repaired) <= set(ALLOWED)
    assert not is_repetitive(repaired)
    given_part = [i for i in sequence if i in ALLOWED]
    kept = [i for n, i in enumerate(given_part) if n == 0 or given_part[n - 1] != i]
    shared = min(len(kept), length)
    assert list(repaired[:shared]) == kept[:shared]
    assert (not notes) == (list(repaired) == list(sequence))


@QUICK
@given(SEQUENCES, st.integers(1, 8), st.integers(0, 99))
def test_repairing_twice_changes_nothing_more(sequence, length, seed) -> None:
    chance = np.random.default_rng(seed)
    once, _ = repair_sequence(sequence, ALLOWED, length, chance)
    assert repair_sequence(once, ALLOWED, length, chance) == (once, ())


def test_notes() -> None:
    chance = np.random.default_rng(0)
    sequence = [OPEN_LEFT, OPEN_LEFT, SHUT_RIGHT, SHUT_LEFT]
    assert repair_sequence(sequence, ALLOWED, 1, chance)[1] == (
        "dropped a repetition of Open(left)",
        "dropped Shut(right): not in this scene",
        "cut 1 skills at the end",
    )
    _, notes = repair_sequence([], ALLOWED, 4, chance)
    assert notes == ("added 4 skills by chance at the end",)


def test_what_stood_around_a_dropped_instance_does_not_repeat() -> None:
    chance = np.random.default_rng(0)
    repaired, notes = repair_sequence([OPEN_LEFT, SHUT_RIGHT, OPEN_LEFT], ALLOWED, 1, chance)
    assert repaired == (OPEN_LEFT,)
    assert len(notes) == 2


def test_one_instance_alone_may_repeat() -> None:
    repaired, _ = repair_sequence([], [OPEN_LEFT], 3, np.random.default_rng(0))
    assert repaired == (OPEN_LEFT,) * 3


def test_drawn_by_chance_evenly() -> None:
    drawn = random_sequence(ALLOWED, 6000, np.random.default_rng(1))
    assert not is_repetitive(drawn)
    shares = Counter(drawn)
    assert all(1800 < shares[i] < 2200 for i in ALLOWED)


def test_same_seed_same_draw() -> None:
    def draw(seed: int) -> list[SkillInstance]:
        return random_sequence(ALLOWED, 10, np.random.default_rng(seed))

    assert draw(3) == draw(3) != draw(4)

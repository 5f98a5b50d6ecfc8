"""Balance: the share of successes that the learned model predicts (paper, Algorithm 4)."""

from __future__ import annotations

import pytest
from garden import (
    GARDEN,
    MODEL,
    OPEN,
    OPEN_LEFT,
    OPEN_RIGHT,
    SHUT_LEFT,
    SHUT_RIGHT,
    SPACE,
    operator,
    state,
)

from skillwrapper.exploration.scores import balance, predicted_success_ratio
from skillwrapper.grounding import UNKNOWN, GroundModel
from skillwrapper.symbols import AbstractModel

GROUND = GroundModel.of(MODEL, GARDEN.objects)


@pytest.mark.parametrize(
    ("sequence", "ratio"),
    [
        ([OPEN_LEFT], 1.0),
        ([SHUT_LEFT], 0.0),
        ([OPEN_LEFT, SHUT_LEFT], 1.0),
        ([OPEN_LEFT, OPEN_LEFT], 0.5),
        ([SHUT_LEFT, OPEN_LEFT, SHUT_LEFT, SHUT_RIGHT], 0.5),
        ([OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT, OPEN_LEFT], 1.0),
    ],
)
def test_by_simulation_in_which_failures_change_nothing(sequence, ratio) -> None:
    assert predicted_success_ratio(GROUND, state(0, 0), sequence) == ratio


def test_nearer_the_target_is_better() -> None:
    half, all_of_it = [OPEN_LEFT, OPEN_LEFT], [OPEN_LEFT, SHUT_LEFT]
    assert balance(GROUND, state(0, 0), half, 0.5) == 0
    assert balance(GROUND, state(0, 0), all_of_it, 0.5) == -0.5
    assert balance(GROUND, state(0, 0), all_of_it, 0.9) == pytest.approx(-0.1)


def test_the_start_is_what_is_seen() -> None:
    assert predicted_success_ratio(GROUND, state(1, 0), [SHUT_LEFT]) == 1
    assert predicted_success_ratio(GROUND, state(0, 0), [SHUT_LEFT]) == 0


def test_what_hangs_on_an_unknown_label_is_not_predicted_to_succeed() -> None:
    assert predicted_success_ratio(GROUND, state(UNKNOWN, 0), [OPEN_LEFT, OPEN_RIGHT]) == 0.5


def test_without_operators_nothing_is_predicted_to_succeed() -> None:
    nothing = GroundModel.of(AbstractModel(GARDEN, (OPEN,), ()), GARDEN.objects)
    assert predicted_success_ratio(nothing, state(0, 0), [OPEN_LEFT, SHUT_LEFT]) == 0


def test_the_first_applicable_operator_counts() -> None:
    twice = (operator("Open", opens=True), operator("Open", opens=True).renamed("Open_2"))
    ground = GroundModel.from_operators(twice, SPACE)
    assert predicted_success_ratio(ground, state(0, 0), [OPEN_LEFT, OPEN_LEFT]) == 0.5

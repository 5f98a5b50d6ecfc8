"""Hypotheses of start and goal: which plan is tried first, and when nothing more is to be hoped."""

from __future__ import annotations

import numpy as np
import pytest
from garden import GARDEN, MODEL, OPEN_LEFT, OPEN_RIGHT, SPACE, operator, state

from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.perception.acquaintance import Acquaintance, FamiliarStates
from skillwrapper.perception.decoding.readings import ErrorRates
from skillwrapper.perception.reading_model import KnownErrors
from skillwrapper.planning.goals import parse_goal
from skillwrapper.planning.hypotheses.beliefs import Beliefs, Evidence
from skillwrapper.planning.hypotheses.doubtful_planner import (
    DoubtfulPlanner,
    KnownScene,
    WantedReading,
)
from skillwrapper.planning.hypotheses.possible_states import PossibleStates
from skillwrapper.planning.hypotheses.settings import HypothesesSettings
from skillwrapper.planning.hypotheses.state_filter import StateFilter
from skillwrapper.symbols import AbstractModel

ONLY_OPENS = AbstractModel(GARDEN, MODEL.predicates, (operator("Open", opens=True),))
SCENE = GARDEN.scene()
SHUT = FamiliarStates.certain(state(0, 0)[np.newaxis])
ACQUAINTANCE = Acquaintance(familiar={SCENE: SHUT})


def beliefs(
    start: Labels,
    wanted: WantedReading,
    model: AbstractModel = MODEL,
    settings: HypothesesSettings | None = None,
) -> Beliefs:
    planner = DoubtfulPlanner(model, ACQUAINTANCE, settings or HypothesesSettings())
    found = planner.beliefs(SCENE, start, wanted)
    assert found is not None
    return found


def test_what_is_read_is_likeliest() -> None:
    found = beliefs(state(0, 0), WantedReading(state(1, 0)))
    assert found.next_plan() == (OPEN_LEFT,)
    assert found.unsolvable == 0.0


def test_a_refuted_reading_gives_way_to_the_next_likely_one() -> None:
    """Read as shut, the left door does not open; so it may be open, and the wish another one."""
    found = beliefs(state(0, 0), WantedReading(state(1, 1)))
    first = found.next_plan()
    assert first is not None
    assert set(first) == {OPEN_LEFT, OPEN_RIGHT}
    found.learn(Evidence(first, succeeded=0))
    second = found.next_plan()
    assert second == ((OPEN_RIGHT,) if first[0] == OPEN_LEFT else (OPEN_LEFT,))


def test_a_plan_counts_for_all_hypotheses_that_it_serves() -> None:
    """What is wanted is hardly known; a plan is worth what all its goals together are."""
    found = beliefs(state(0, 0), WantedReading(written=parse_goal("open(left)", SPACE)))
    assert found.next_plan() == (OPEN_LEFT,)
    assert len({h.goals for h in found.hypotheses}) == 1


def test_pictures_on_the_way_speak_of_the_start() -> None:
    """Three skills later the right door is seen open, which nobody opened."""
    found = beliefs(state(0, 0), WantedReading(state(1, 1)))
    plan = (OPEN_LEFT, OPEN_RIGHT)
    blind = beliefs(state(0, 0), WantedReading(state(1, 1)))
    found.learn(Evidence(plan, 1, [state(1, 1)]))
    blind.learn(Evidence(plan, 1))
    right_was_open = [h.start == _number(found, state(0, 1)) for h in found.hypotheses]
    seen, unseen = (b.probabilities[right_was_open].sum() for b in (found, blind))
    assert seen > unseen


def test_impossible_needs_the_mass_of_hypotheses() -> None:
    """Doors only open: to shut one is impossible, unless the wish was misread."""
    found = beliefs(state(1, 0), WantedReading(state(0, 0)), ONLY_OPENS)
    assert 0.5 < found.unsolvable < 1.0
    while (plan := found.next_plan()) is not None:
        found.learn(Evidence(plan, succeeded=len(plan)))  # and the wish is not fulfilled
    assert found.is_impossible


def test_a_likely_misreading_is_no_impossibility() -> None:
    """The same, where one reading of the wish is known to be worth little."""
    often = KnownErrors({"open": ErrorRates(0.3, 0.4, 100.0, 100.0)}, dirty=0.9)
    acquaintance = Acquaintance(often, ACQUAINTANCE.familiar)
    planner = DoubtfulPlanner(ONLY_OPENS, acquaintance)
    found = planner.beliefs(SCENE, state(1, 0), WantedReading(state(0, 1)))
    assert found is not None
    assert not found.is_impossible
    assert found.next_plan() is not None


def test_positive_goals_leave_the_rest_open() -> None:
    found = beliefs(state(0, 1), WantedReading(state(1, 0), positive_only=True))
    assert found.next_plan() == (OPEN_LEFT,)


@pytest.mark.parametrize(("limit", "known"), [(4, True), (3, False)])
def test_worlds_that_are_too_large_are_left_alone(limit: int, known: bool) -> None:
    ground = GroundModel.of(MODEL, GARDEN.objects)
    found = PossibleStates.explore(ground, SHUT, limit)
    assert (found is not None) is known
    planner = DoubtfulPlanner(MODEL, Acquaintance())  # knows no state of the scene
    assert planner.beliefs(SCENE, state(0, 0), WantedReading(state(1, 0))) is None


def test_a_state_that_is_less_sure_comes_after_all_that_surer_ones_lead_to() -> None:
    """Doors that only open; that one was shut at first is rather a misreading."""
    ground = GroundModel.of(ONLY_OPENS, GARDEN.objects)
    familiar = FamiliarStates(np.array([[1, 0], [0, 0]], dtype=np.int8), np.array([-0.1, -3.0]))
    found = PossibleStates.explore(ground, familiar, 100)
    assert found is not None
    assert found.labels.tolist() == [[1, 0], [1, 1], [0, 0], [0, 1]]
    assert found.nats.tolist() == [-0.1, -0.1, -3.0, -3.0]
    cut_off = PossibleStates.explore(ground, familiar, 2)
    assert cut_off is not None
    assert cut_off.labels.tolist() == [[1, 0], [1, 1]]


def _number(found: Beliefs, labels: Labels) -> int:
    possible = found._possible
    return int(np.flatnonzero((possible.labels == labels).all(axis=1))[0])


def filtered(start: Labels) -> tuple[StateFilter, KnownScene]:
    known = DoubtfulPlanner(MODEL, ACQUAINTANCE).known(SCENE)
    assert known is not None
    return StateFilter(known, start), known


def test_a_filter_keeps_up_with_what_is_done() -> None:
    now, known = filtered(state(0, 0))
    wanted = known.goals(WantedReading(written=parse_goal("open(left)", SPACE)))
    assert now.reached(wanted) < 0.1
    now.ran(OPEN_LEFT, succeeded=True)
    assert now.likeliest.tolist() == [1, 0]
    assert now.reached(wanted) > 0.99


def test_what_failed_speaks_against_what_was_read() -> None:
    """What is open already does not open."""
    now, _ = filtered(state(0, 0))
    now.ran(OPEN_LEFT, succeeded=False)
    assert now.likeliest.tolist() == [1, 0]


def test_what_somebody_moves_is_believed_once_it_is_seen_often_enough() -> None:
    now, _ = filtered(state(0, 0))
    for _ in range(4):
        now.look(state(1, 1))
    assert now.likeliest.tolist() == [1, 1]

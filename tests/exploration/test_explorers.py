"""The protocol of explorers: given the situation, the next skill or the end of the episode."""

from __future__ import annotations

import pytest
from garden import GARDEN, MODEL, OPEN_LEFT, SEEN, is_repetitive, state
from test_explorer import DAY, Proposer, episode

from skillwrapper.errors import UnknownNameError
from skillwrapper.exploration.explorers import EXPLORERS, Explorer, Situation, make_explorer
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.world import SkillInstance, Transition

NOTHING = Fit(GARDEN, MODEL.predicates, lambda skill: SkillFit(skill.name, (), ()))


def situation(*done: SkillInstance, left: int = 4) -> Situation:
    transitions = tuple(Transition(SEEN, i, True, SEEN) for i in done)
    return Situation(
        GARDEN.scene(), SEEN, transitions, left, lambda: NOTHING, lambda space: state(0, 0)
    )


def make(name: str, proposer: Proposer | None = None, seed: int = 0) -> Explorer:
    settings = ExplorationSettings(explorer=name, budget=4, least_length=4)
    return make_explorer(GARDEN, proposer or Proposer(DAY), settings, seed)


def episode_of(explorer: Explorer, most: int = 4) -> list[SkillInstance]:
    done: list[SkillInstance] = []
    while len(done) < most:
        chosen = explorer.next_skill(situation(*done, left=most - len(done)))
        assert chosen.reason
        if chosen.instance is None:
            break
        done.append(chosen.instance)
    explorer.record(episode(*((i, True) for i in done)))
    return done


def test_a_proposed_sequence_is_run_to_its_end() -> None:
    proposer = Proposer(DAY)
    assert episode_of(make("paper", proposer), most=9) == DAY
    assert len(proposer.questions) == 1


def test_how_a_sequence_was_chosen_is_told_once() -> None:
    explorer = make("paper")
    assert explorer.next_skill(situation()).sequence is not None
    assert explorer.next_skill(situation(OPEN_LEFT)).sequence is None


def test_chance_looks_at_nothing_and_never_repeats() -> None:
    drawn = episode_of(make("random"), most=40)
    assert not is_repetitive(drawn)
    assert set(drawn) == set(GARDEN.skill_instances)


@pytest.mark.parametrize("name", EXPLORERS)
def test_the_same_seed_chooses_the_same(name: str) -> None:
    first, second = make(name, seed=3), make(name, seed=3)
    assert [episode_of(first) for _ in range(3)] == [episode_of(second) for _ in range(3)]


def test_what_costs_calls_is_not_done_before_somebody_looks() -> None:
    def fail(*_: object) -> object:
        raise AssertionError("nobody should ask")

    blind = Situation(GARDEN.scene(), SEEN, (), 3, fail, fail)  # type: ignore[arg-type]
    assert make("random").next_skill(blind).instance is not None


def test_a_name_that_is_none() -> None:
    with pytest.raises(UnknownNameError, match="paper"):
        make("pepper")

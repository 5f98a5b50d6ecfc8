"""Explorers by their names."""

from __future__ import annotations

import pytest
from garden import GARDEN, SEEN, TESTED, is_repetitive, situation, state

from skillwrapper.errors import UnknownNameError
from skillwrapper.exploration.explorer import Explorer, Situation
from skillwrapper.exploration.explorers import EXPLORERS, make_explorer
from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.world import Episode, SkillInstance, Transition


class Nobody:
    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        return ProposalAnswer(())


def make(name: str, seed: int = 0) -> Explorer:
    settings = ExplorationSettings(explorer=name, budget=4, least_length=4)
    return make_explorer(GARDEN, Nobody(), settings, seed)


def episode_of(explorer: Explorer, most: int = 4) -> list[SkillInstance]:
    done: list[SkillInstance] = []
    while len(done) < most:
        chosen = explorer.next_skill(situation(state(0, 0), *done, left=most - len(done)))
        assert chosen.reason
        if chosen.instance is None:
            break
        done.append(chosen.instance)
    transitions = tuple(Transition(SEEN, i, True, SEEN) for i in done)
    explorer.record(Episode(GARDEN.scene(), 0, transitions))
    return done


def test_chance_looks_at_nothing_and_never_repeats() -> None:
    drawn = episode_of(make("random"), most=40)
    assert not is_repetitive(drawn)
    assert set(drawn) == set(GARDEN.skill_instances)


@pytest.mark.parametrize("name", ["paper", "random"])
def test_the_same_seed_chooses_the_same(name: str) -> None:
    first, second = make(name, seed=3), make(name, seed=3)
    assert [episode_of(first) for _ in range(3)] == [episode_of(second) for _ in range(3)]


def test_what_costs_calls_is_not_done_before_somebody_looks() -> None:
    def fail(*_: object) -> object:
        raise AssertionError("nobody should ask")

    blind = Situation(GARDEN.scene(), SEEN, (), 3, fail, fail)  # type: ignore[arg-type]
    assert make("random").next_skill(blind).instance is not None


def test_the_settings_name_an_explorer_that_there_is() -> None:
    assert ExplorationSettings().explorer in EXPLORERS
    with pytest.raises(UnknownNameError, match="paper"):
        make("pepper")


def test_a_situation_learns_and_reads_once() -> None:
    calls: list[str] = []
    found = Situation(
        GARDEN.scene(), SEEN, (), 3,
        lambda: calls.append("learn") or TESTED,  # type: ignore[func-returns-value]
        lambda space: calls.append("read") or state(0, 1),  # type: ignore[func-returns-value]
    )  # fmt: skip
    assert found.state.tolist() == found.state.tolist() == [0, 1]
    assert found.untested == {"Open_1": frozenset(), "Shut_1": frozenset()}
    assert calls == ["learn", "read"]

"""Exploring by plan in a small world: a lamp behind a door, and a bell that never rings."""

from __future__ import annotations

import pytest
from house import HOUSE, House

from skillwrapper.exploration.explorer import NextSkill
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.settings import ExplorationSettings


def explore(seed: int, episodes: int = 4, length: int = 9) -> tuple[House, list[NextSkill]]:
    house = House()
    explorer = PlannedExplorer(HOUSE, ExplorationSettings(), seed)
    choices = []
    for _ in range(episodes):
        for step in range(length):
            choices.append(explorer.next_skill(house.situation(length - step)))
            if choices[-1].instance is None:
                break
            house.run(choices[-1].instance)
        explorer.record(house.reset())
    return house, choices


@pytest.mark.parametrize("seed", range(3))
def test_what_needs_two_steps_is_found(seed: int) -> None:
    house, _ = explore(seed)
    done = [r.transition for r in house.notebook.recorded.records]
    assert any(t.success for t in done if t.instance.skill == "Light")


def test_choices_have_reasons_and_follow_from_the_seed() -> None:
    first, second = explore(5)[1], explore(5)[1]
    assert first == second
    assert all(choice.reason for choice in first)
    assert any(choice.reason.startswith("tests whether") for choice in first)
    assert any("Tie was never tried like this" in choice.reason for choice in first)


def test_an_episode_ends_where_nothing_is_worth_a_try() -> None:
    """All that can be tried was tried here, and nothing leads away."""
    house = House()
    explorer = PlannedExplorer(HOUSE, ExplorationSettings(), 0)
    for wanted in sorted(set(HOUSE.skill_instances)):
        if wanted.skill == "Tie":
            house.run(wanted)
    stuck = explorer.next_skill(house.situation(left=1))
    while stuck.instance is not None:
        house.run(stuck.instance)
        stuck = explorer.next_skill(house.situation(left=1))
    assert stuck.reason == "all was tried here, and nothing leads away"
    assert house.done


def test_where_all_seems_known_it_goes_elsewhere_or_does_what_it_rarely_did() -> None:
    """States that look alike to the vocabulary may still differ."""
    house = House()
    explorer = PlannedExplorer(HOUSE, ExplorationSettings(lookahead=0), 3)
    reasons = set()
    for _ in range(60):
        chosen = explorer.next_skill(house.situation())
        if chosen.instance is None:
            explorer.record(house.reset())
            continue
        reasons.add(chosen.reason)
        house.run(chosen.instance)
        if len(house.done) == 9:
            explorer.record(house.reset())
    assert "was tried most rarely; nothing seems worth more" in reasons
    assert "drawn by chance to get elsewhere, as nothing seems new" in reasons

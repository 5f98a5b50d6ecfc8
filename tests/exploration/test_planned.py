"""Exploring by plan in a small world: a lamp behind a door, and a bell that never rings."""

from __future__ import annotations

from dataclasses import replace

import pytest
from house import HOUSE, House
from notebook import instance

from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.learning.fitting import Fit


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


def _frail_light(house: House, left: int) -> Situation:
    """A situation in which the only success of Light rests on doubtful labels."""
    situation = house.situation(left)
    fit = situation.fit
    (number,) = (
        n
        for n, record in enumerate(house.notebook.recorded.records)
        if record.transition.success and record.transition.instance.skill == "Light"
    )
    frail = {"Light": (number,)}
    doubtful = Fit(
        fit.domain,
        fit.predicates,
        lambda skill: replace(fit.skill(skill.name), frail=frail.get(skill.name, ())),
    )
    return replace(situation, learn=lambda: doubtful)


def test_what_rests_on_doubtful_labels_is_seen_again() -> None:
    house = House()
    explorer = PlannedExplorer(HOUSE, ExplorationSettings(), 0)
    for name in ("Open(h, front)", "Open(h, back)", "Light(h, lamp)"):
        explorer.next_skill(house.situation())
        house.run(instance(name))
    explorer.record(house.reset())
    known = explorer.think(house.situation()).worth.repeat
    thought = explorer.think(_frail_light(house, 9))
    worth = dict(zip(thought.scene.instances, thought.worth.repeat.max(axis=0), strict=True))
    assert not known.any()
    assert {i.skill for i, value in worth.items() if value > 0} == {"Light"}

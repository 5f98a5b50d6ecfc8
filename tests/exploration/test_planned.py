"""Exploring by plan in a small world: a lamp behind a door, and a bell that never rings."""

from __future__ import annotations

import pytest
from notebook import Notebook, make_domain, picture

from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.symbols import Predicate
from skillwrapper.world import Episode, SkillInstance, Transition

HOUSE = make_domain(
    types={"hand": (), "thing": (), "door": ("thing",), "lamp": ("thing",)},
    objects={"h": "hand", "front": "door", "back": "door", "lamp": "lamp"},
    skills={"Open": "hand door", "Light": "hand lamp", "Tie": "hand thing thing"},
)
OPEN, AIRY = Predicate("open", ("door",)), Predicate("airy", ())
SCENE = HOUSE.scene()


class House:
    """Doors open one after the other; the lamp can only be lit where it is airy. Nothing ties."""

    def __init__(self) -> None:
        self.notebook = Notebook(HOUSE, OPEN, AIRY)
        self.state = ""
        self.done: list[Transition] = []

    def situation(self, left: int = 9) -> Situation:
        seen = picture(self.state)
        return Situation(
            SCENE, seen, tuple(self.done), left, self.notebook.fit,
            lambda space: self.notebook.labels(space, [seen])[0],
        )  # fmt: skip

    def run(self, chosen: SkillInstance) -> bool:
        works = {
            "Open": "open(front)" in self.state or chosen.arguments[1] == "front",
            "Light": "open(back)" in self.state,
            "Tie": False,
        }[chosen.skill]
        after = self.state
        if works and chosen.skill == "Open" and str(chosen.arguments[1]) not in after:
            after = (
                "open(front)" if chosen.arguments[1] == "front" else f"{after} open(back) airy()"
            )
        before, then = picture(self.state), picture(after)
        self.done.append(Transition(before, chosen, works, then))
        self.notebook.recorded.add(Episode(SCENE, 0, (self.done[-1],)))
        self.state = after
        return works

    def reset(self) -> Episode:
        episode = Episode(SCENE, 0, tuple(self.done))
        self.state, self.done = "", []
        return episode


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

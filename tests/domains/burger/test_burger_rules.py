"""The rules of the kitchen, one line each, and the size of the space they span."""

from __future__ import annotations

import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.rules import effect, obstacle
from skillwrapper.domains.burger.states import HAND, TABLE, BurgerState
from skillwrapper.errors import InternalError
from skillwrapper.world import SkillInstance


def run(skill: str, *arguments: str) -> SkillInstance:
    return SkillInstance(skill, ("robot", *arguments))


def kitchen(cut: bool = False, cooked: bool = False, **places: str) -> BurgerState:
    items = ("lettuce", "patty", "topbun", "bottombun")
    return BurgerState(tuple(places.get(item, TABLE) for item in items), cut, cooked)


@pytest.mark.parametrize(
    ("state", "instance", "following"),
    [
        (kitchen(), run("Pick", "patty"), kitchen(patty=HAND)),
        (kitchen(patty="topbun"), run("Pick", "patty"), kitchen(patty=HAND)),
        (kitchen(patty="stove"), run("Pick", "patty"), kitchen(patty=HAND)),
        (kitchen(patty=HAND), run("Place", "patty", "board"), kitchen(patty="board")),
        (kitchen(patty=HAND), run("Stack", "patty", "topbun"), kitchen(patty="topbun")),
        (
            kitchen(topbun=HAND, patty="stove"),
            run("Stack", "topbun", "patty"),
            kitchen(topbun="patty", patty="stove"),
        ),
        (kitchen(lettuce="board"), run("Cut", "lettuce"), kitchen(lettuce="board", cut=True)),
        (kitchen(patty="stove"), run("Cook", "patty"), kitchen(patty="stove", cooked=True)),
    ],
    ids=str,
)
def test_skill_succeeds(
    state: BurgerState, instance: SkillInstance, following: BurgerState
) -> None:
    assert obstacle(state, instance) is None
    assert effect(state, instance) == following


@pytest.mark.parametrize(
    ("state", "instance", "reason"),
    [
        (kitchen(topbun=HAND), run("Pick", "patty"), "it holds the topbun"),
        (kitchen(patty=HAND), run("Pick", "patty"), "it holds the patty"),
        (kitchen(topbun="patty"), run("Pick", "patty"), "the topbun lies on the patty"),
        (kitchen(), run("Place", "patty", "stove"), "does not hold the patty"),
        (kitchen(topbun=HAND), run("Place", "patty", "stove"), "does not hold the patty"),
        (
            kitchen(topbun=HAND, patty="stove"),
            run("Place", "topbun", "stove"),
            "the patty lies on the stove already",
        ),
        (kitchen(), run("Stack", "patty", "topbun"), "does not hold the patty"),
        (kitchen(topbun=HAND), run("Stack", "patty", "topbun"), "does not hold the patty"),
        (
            kitchen(patty=HAND, lettuce="topbun"),
            run("Stack", "patty", "topbun"),
            "the lettuce lies on the topbun",
        ),
        (kitchen(), run("Cut", "lettuce"), "does not lie on the board"),
        (kitchen(lettuce="stove"), run("Cut", "lettuce"), "does not lie on the board"),
        (kitchen(lettuce=HAND), run("Cut", "lettuce"), "does not lie on the board"),
        (
            kitchen(lettuce="topbun", topbun="board"),
            run("Cut", "lettuce"),
            "does not lie on the board",
        ),
        (kitchen(lettuce="board", cut=True), run("Cut", "lettuce"), "already cut"),
        (kitchen(lettuce="board", patty=HAND), run("Cut", "lettuce"), "it holds the patty"),
        (
            kitchen(lettuce="board", patty="lettuce"),
            run("Cut", "lettuce"),
            "the patty lies on the lettuce",
        ),
        (kitchen(patty="board"), run("Cook", "patty"), "does not lie on the stove"),
        (kitchen(patty="stove", cooked=True), run("Cook", "patty"), "already cooked"),
        (kitchen(patty="stove", topbun=HAND), run("Cook", "patty"), "it holds the topbun"),
        (
            kitchen(patty="stove", topbun="patty"),
            run("Cook", "patty"),
            "the topbun lies on the patty",
        ),
    ],
    ids=str,
)
def test_skill_fails_and_says_why(state: BurgerState, instance: SkillInstance, reason: str) -> None:
    assert reason in (obstacle(state, instance) or "")


def test_what_is_no_skill_is_our_own_mistake() -> None:
    with pytest.raises(InternalError):
        obstacle(kitchen(), run("Wash", "patty"))
    with pytest.raises(InternalError):
        effect(kitchen(), run("Wash", "patty"))


def test_size_of_the_space() -> None:
    environment = BurgerEnvironment()
    states, instances = environment.reachable_states(), environment.domain.skill_instances
    assert states[0] == kitchen()
    assert len(instances) == 26
    assert len(states) == len(set(states)) == 2417
    successes = sum(obstacle(state, i) is None for state in states for i in instances)
    assert successes == 5806

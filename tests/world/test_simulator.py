"""From a start, rules and a drawing follows a whole environment with all its states."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import Any, NamedTuple

import numpy as np
import pytest
from lamp_environment import LAMP_DOMAIN

import skillwrapper
from skillwrapper.errors import ConfigurationError, RobotError, UnknownNameError
from skillwrapper.world import Object, Scene, SkillInstance
from skillwrapper.world.capabilities import capabilities_of
from skillwrapper.world.conformance import check_environment

HAND, ONE, TWO = Object("hand", ("hand",)), Object("one", ("lamp",)), Object("two", ("lamp",))
LAMPS = replace(
    LAMP_DOMAIN,
    objects=(HAND, ONE, TWO),
    declared_scenes=(Scene("both", (HAND, ONE, TWO)), Scene("single", (HAND, ONE))),
)


class Colour(Enum):
    GREEN = "green"
    RED = "red"


@dataclass(frozen=True)
class Lit:
    """Which lamps are lit, and of which colour everything is."""

    lamps: frozenset[str] = frozenset()
    colour: Colour = Colour.GREEN


class Lamps(skillwrapper.Simulator[Lit]):
    def __init__(self) -> None:
        super().__init__(LAMPS)

    def start(self) -> Lit:
        return Lit()

    def obstacle(self, state: Lit, instance: SkillInstance) -> str | None:
        is_lit = instance.arguments[1] in state.lamps
        return "nothing to do" if is_lit == (instance.skill == "Light") else None

    def effect(self, state: Lit, instance: SkillInstance) -> Lit:
        return replace(state, lamps=state.lamps ^ {instance.arguments[1]})

    def draw(self, state: Lit, layout: int) -> np.ndarray[Any, Any]:
        shown = np.full((4, 4, 3), layout % 256, np.uint8)
        for number, thing in enumerate(self.scene.objects):
            shown[0, number] = 255 if thing.name in state.lamps else 100
        return shown


def test_all_rules_are_kept() -> None:
    check_environment(Lamps)
    assert capabilities_of(Lamps()) == ("settable", "simulable", "enumerable", "replayable")


def test_states_are_those_of_the_present_scene() -> None:
    lamps = Lamps()
    assert len(lamps.reachable_states()) == 4
    lamps.reset(seed=0, scene="single")
    assert lamps.reachable_states() == (Lit(), Lit(frozenset({"one"})))
    with pytest.raises(UnknownNameError, match="unknown object 'two'"):
        lamps.execute(SkillInstance("Light", ("hand", "two")))


def test_failures_are_told() -> None:
    lamps = Lamps()
    with pytest.raises(RobotError, match="expected reset"):
        lamps.get_state()
    lamps.reset(seed=0)
    outcome = lamps.execute(SkillInstance("PutOut", ("hand", "one")))
    assert (outcome.success, outcome.message) == (False, "nothing to do")


def test_states_are_described_in_one_way_only() -> None:
    lamps = Lamps()
    described = {"lamps": ["one", "two"], "colour": "green"}
    for order in (("one", "two"), ("two", "one")):
        assert lamps.state_to_data(Lit(frozenset(order))) == described
    assert lamps.state_from_data(described) == Lit(frozenset({"one", "two"}))
    for wrong in ({}, {**described, "more": 1}, {**described, "colour": "blue"}, {"state": 1}):
        with pytest.raises(ConfigurationError, match="expected the description of a state"):
            lamps.state_from_data(wrong)


def test_drawing_that_is_no_picture_is_told() -> None:
    class Unseen(Lamps):
        def draw(self, state: Lit, layout: int) -> Any:
            return {"top": None}

    with pytest.raises(RobotError, match=r"draw: camera 'top': expected an array"):
        Unseen().reset(seed=0)


class Place(NamedTuple):
    row: int
    name: str


class Still(skillwrapper.Simulator[Any]):
    """Nothing ever happens."""

    first: Any

    def __init__(self) -> None:
        super().__init__(LAMPS)

    def start(self) -> Any:
        return self.first

    def obstacle(self, state: Any, instance: SkillInstance) -> str | None:
        return "nothing ever happens"

    def effect(self, state: Any, instance: SkillInstance) -> Any:
        return state

    def draw(self, state: Any, layout: int) -> np.ndarray[Any, Any]:
        return np.zeros((2, 2, 3), np.uint8)


class Pairs(Still, skillwrapper.Simulator[frozenset[tuple[str, str]]]):
    first = frozenset({("one", "two"), ("two", "one")})


@pytest.mark.parametrize("state", [3, "lit", (1, "a"), frozenset({"a", "b"}), Place(2, "left")])
def test_states_may_be_of_any_kind(state: Any) -> None:
    check_environment(type("Made", (Still,), {"first": state}))


def test_kinds_of_states_may_be_declared() -> None:
    check_environment(Pairs)
    described = {"state": [["one", "two"], ["two", "one"]]}
    assert Pairs().state_to_data(Pairs.first) == described

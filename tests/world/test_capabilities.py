"""What an environment can do is asked for where it is needed, and named where it is missing."""

from __future__ import annotations

import pytest
from lamp_environment import LampEnvironment

from skillwrapper.errors import ConfigurationError, ConformanceError, UnknownNameError
from skillwrapper.world import Enumerable, Judged, Observation, Replayable, Settable, Truthful
from skillwrapper.world.capabilities import (
    CAPABILITIES,
    capabilities_of,
    look_at,
    require,
    supports,
)
from skillwrapper.world.conformance import check_environment


class JudgedLamp(LampEnvironment):
    goals = ("lit", "dark")

    def is_reached(self, goal: str) -> bool:
        if goal not in self.goals:
            raise UnknownNameError("goal", goal, self.goals)
        return self._lit == (goal == "lit")


class Unrepeatable(LampEnvironment):
    replayable = False


def test_capabilities_are_told_by_members() -> None:
    lamp = LampEnvironment()
    assert capabilities_of(lamp) == (
        "settable",
        "simulable",
        "enumerable",
        "truthful",
        "replayable",
    )
    assert supports(JudgedLamp(), Judged)
    assert not supports(lamp, Judged)
    assert not supports(Unrepeatable(), Replayable)


@pytest.mark.parametrize("capability", CAPABILITIES)
def test_members_of_a_protocol_are_those_that_are_looked_for(capability: type) -> None:
    own = {name for name in vars(capability) if not name.startswith("_")}
    assert own == set(CAPABILITIES[capability][1])


def test_what_is_missing_is_named() -> None:
    class Forgetful(LampEnvironment):
        successor = None  # type: ignore[assignment]

    with pytest.raises(ConfigurationError) as caught:
        require(Forgetful(), Enumerable, "exact verification")
    assert str(caught.value) == (
        "lamp: exact verification needs an environment that is enumerable; this one lacks "
        "successor (it is settable, truthful, replayable)"
    )
    lamp = LampEnvironment()
    assert require(lamp, Truthful, "the baseline") is lamp


def test_looking_at_states_leaves_the_world_as_it_was() -> None:
    lamp = LampEnvironment()
    before = lamp.reset(seed=3)
    dark, lit = look_at(require(lamp, Settable, "a test"), (False, True))
    assert dark.key == before.key != lit.key
    assert lamp.observe().key == before.key


def test_goals_are_checked() -> None:
    check_environment(JudgedLamp)

    class Undecided(JudgedLamp):
        def is_reached(self, goal: str) -> bool:
            super().is_reached(goal)
            return "perhaps"  # type: ignore[return-value]

    class TwiceLit(JudgedLamp):
        goals = ("lit", "lit")

    class AnyGoal(JudgedLamp):
        def is_reached(self, goal: str) -> bool:
            return False

    for broken, method in ((Undecided, "is_reached"), (TwiceLit, "goals"), (AnyGoal, "is_reached")):
        with pytest.raises(ConformanceError, match=f"judged: {method}"):
            check_environment(broken)


class GreyLamp(LampEnvironment):
    """A camera with noise: no two pictures of a state are the same."""

    replayable = False
    looks = 0

    def observe_state(self, state: bool) -> Observation:
        seed = self._seed
        type(self).looks += 1
        self._seed = None if seed is None else seed + type(self).looks
        try:
            return super().observe_state(state)
        finally:
            self._seed = seed


def test_pictures_of_one_state_may_differ() -> None:
    """Fault 31: states are compared where states are meant, not pictures."""
    lamp = GreyLamp()
    lamp.reset(seed=0)
    assert lamp.observe().key != lamp.observe().key
    check_environment(GreyLamp)
    check_environment(GreyLamp, level="robot")
    check_environment(GreyLamp, level="simulator")


def test_a_simulator_says_so_if_its_pictures_repeat() -> None:
    class Liar(GreyLamp):
        replayable = True

    with pytest.raises(ConformanceError, match=r"observe: the first observe\(\) after reset"):
        check_environment(Liar)

"""A Gymnasium environment as a robot: keeps the rules, and its options end."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest
from notebook import instance, make_domain

from skillwrapper.errors import ConfigurationError, MissingDependencyError, RobotError
from skillwrapper.robots.gymnasium_robot import GymnasiumRobot, Option, Play
from skillwrapper.world.conformance import check_environment
from skillwrapper.world.conformance_report import Level
from skillwrapper.world.robot import RobotEnvironment

gymnasium = pytest.importorskip("gymnasium", reason="the extra gymnasium is not installed")

DOMAIN = make_domain(
    {"walker": (), "lamp": ()},
    {"walker": "walker", "left": "lamp", "right": "lamp"},
    {"GoTo": "walker lamp", "Toggle": "walker lamp"},
)
PLACES = {"left": 0, "right": 6}
LEFT, RIGHT, PRESS = range(3)


class Corridor(gymnasium.Env):
    """A walker between two lamps, which it toggles where it stands."""

    action_space = gymnasium.spaces.Discrete(3)
    observation_space = gymnasium.spaces.Box(0, 6, (3,), int)

    def __init__(self, render_mode: str | None = "rgb_array", longest: int = 10_000) -> None:
        self.render_mode, self.longest = render_mode, longest

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        self.place, self.lit, self.steps = int(self.np_random.integers(2, 5)), [0, 0], 0
        return self._seen(), {}

    def step(self, action: int) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self.steps += 1
        if action == PRESS and self.place in PLACES.values():
            self.lit[self.place // 6] ^= 1
        self.place = min(6, max(0, self.place + {LEFT: -1, RIGHT: 1}.get(action, 0)))
        return self._seen(), 0.0, False, self.steps >= self.longest, {}

    def render(self) -> Any:
        picture = np.full((20, 70, 3), 40, np.uint8)
        picture[:, self.place * 10 : self.place * 10 + 10, 0] = 200
        picture[:5, :10], picture[:5, 60:] = 255 * self.lit[0], 255 * self.lit[1]
        return picture if self.render_mode else None

    def _seen(self) -> Any:
        return np.array([self.place, *self.lit])


def toggle(play: Play, walker: str, lamp: str) -> bool:
    """A skill as a callable."""
    if play.observation[0] != PLACES[lamp]:
        return False
    play.step(PRESS)
    return True


go_to = Option(
    act=lambda seen, walker, lamp: RIGHT if seen[0] < PLACES[lamp] else LEFT,
    ends=lambda seen, walker, lamp: True if seen[0] == PLACES[lamp] else None,
)
SKILLS = {"GoTo": go_to, "Toggle": toggle}


def world(*, replayable: bool = True, **given: Any) -> RobotEnvironment:
    robot = GymnasiumRobot(Corridor(**given), SKILLS, replayable=replayable)
    return RobotEnvironment(robot, DOMAIN)


@pytest.mark.parametrize("replayable", [True, False])
def test_it_keeps_the_rules(replayable: bool) -> None:
    level = check_environment(lambda: world(replayable=replayable))
    assert level is (Level.SIMULATOR if replayable else Level.ROBOT)


def test_an_option_runs_to_its_end_and_a_callable_says_how_it_went() -> None:
    environment = world()
    environment.reset(seed=3)
    assert not environment.execute(instance("Toggle(walker, right)")).success
    assert environment.execute(instance("GoTo(walker, right)")).success
    before = environment.observe()
    assert environment.execute(instance("Toggle(walker, right)")).success
    assert environment.observe().key != before.key


def test_an_option_that_does_not_end_has_failed() -> None:
    option = Option(lambda seen: PRESS, lambda seen: None, steps=5)
    play = Play(Corridor(), None, {})
    play.env.reset(seed=0)
    assert option(play) == (False, "after 5 steps")


def test_after_the_end_of_the_episode_every_skill_fails_until_the_next_reset() -> None:
    environment = world(longest=1)
    environment.reset(seed=3)
    outcome = environment.execute(instance("GoTo(walker, right)"))
    assert (outcome.success, "over" in outcome.message) == (False, True)
    assert not environment.execute(instance("Toggle(walker, right)")).success
    environment.reset(seed=3)
    assert "over" not in environment.execute(instance("Toggle(walker, right)")).message


def test_mistakes_are_named() -> None:
    with pytest.raises(RobotError, match="render_mode"):
        world(render_mode=None).reset(seed=0)
    environment = RobotEnvironment(GymnasiumRobot(Corridor(), {"GoTo": go_to}), DOMAIN)
    environment.reset(seed=0)
    with pytest.raises(RobotError, match="expected a skill of GoTo, got 'Toggle'"):
        environment.execute(instance("Toggle(walker, left)"))
    with pytest.raises(ConfigurationError, match="NoSuchWorld"):
        GymnasiumRobot.make("NoSuchWorld-v0", SKILLS)


def test_without_gymnasium_it_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    with pytest.raises(MissingDependencyError, match=r"skillwrapper\[gymnasium\]"):
        GymnasiumRobot.make("CartPole-v1", {})

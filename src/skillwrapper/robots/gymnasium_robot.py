"""A Gymnasium environment as a robot: a skill is a callable, or an option, over ``env.step``.

In ``robot.py`` of a domain::

    def make_robot():
        return GymnasiumRobot.make("my/Kitchen-v0", {"Open": Option(act, ends), "Push": push})
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, Self, TypeAlias

from skillwrapper.errors import ConfigurationError, MissingDependencyError, RobotError
from skillwrapper.world.pictures import Look
from skillwrapper.world.robot import Robot

_OVER = "the episode of the environment is over"


class GymnasiumEnv(Protocol):
    """What is used of ``gymnasium.Env``."""

    def reset(self, *, seed: int | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin an episode."""
        ...

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Observation, reward, terminated, truncated, info."""
        ...

    def render(self) -> Any:
        """A picture, with ``render_mode="rgb_array"``."""
        ...

    def close(self) -> None:
        """Release everything."""
        ...


@dataclass
class Play:
    """An environment as skills see it, with what came of the last step.

    Attributes:
        env: the environment.
        observation: what the last step, or the reset, observed.
        info: what it told besides.
        is_over: whether the episode has ended; nothing can be done then until the next reset.
    """

    env: GymnasiumEnv
    observation: Any
    info: Mapping[str, Any]
    is_over: bool = False

    def step(self, action: Any) -> Any:
        """Take one step; the observation after it. Does nothing once the episode is over."""
        if not self.is_over:
            self.observation, _, terminated, truncated, self.info = self.env.step(action)
            self.is_over = bool(terminated or truncated)
        return self.observation


@dataclass(frozen=True)
class Option:
    """A policy with an end (Sutton, Precup, Singh 1999), over objects.

    Attributes:
        act: the next action, from the observation and the skill's arguments.
        ends: after each step and before the first, from the same: True if the skill has succeeded,
            False if it has failed, None if it goes on.
        steps: how many steps it may take; then it has failed.
    """

    act: Callable[..., Any]
    ends: Callable[..., bool | None]
    steps: int = 200

    def __call__(self, play: Play, *arguments: str) -> tuple[bool, str]:
        """Follow the policy to its end."""
        for _ in range(self.steps):
            ended = self.ends(play.observation, *arguments)
            if ended is not None:
                return bool(ended), ""
            if play.is_over:
                return False, _OVER
            play.step(self.act(play.observation, *arguments))
        return self.ends(play.observation, *arguments) is True, f"after {self.steps} steps"


GymnasiumSkill: TypeAlias = "Option | Callable[..., bool | tuple[bool, str]]"
"""Called with a ``Play`` and the arguments; says whether it succeeded, perhaps with a message."""


class GymnasiumRobot(Robot):
    """Runs skills in a Gymnasium environment.

    Args:
        env: with ``render_mode="rgb_array"``.
        skills: by their names in ``domain.yaml``.
        replayable: whether the same seed and skills give the same pictures, byte for byte.
    """

    def __init__(
        self, env: GymnasiumEnv, skills: Mapping[str, GymnasiumSkill], *, replayable: bool = False
    ) -> None:
        self._env, self._skills = env, dict(skills)
        self._play: Play | None = None
        self.replayable = replayable

    @classmethod
    def make(
        cls,
        name: str,
        skills: Mapping[str, GymnasiumSkill],
        *,
        replayable: bool = False,
        **given: Any,
    ) -> Self:
        """In an environment that is registered; what else is given goes to ``gymnasium.make``.

        Raises:
            MissingDependencyError: if Gymnasium is not installed.
            ConfigurationError: if there is no such environment.
        """
        try:
            import gymnasium  # noqa: PLC0415
        except ImportError as error:
            how = "pip install 'skillwrapper[gymnasium]'"
            raise MissingDependencyError("Gymnasium", how) from error
        try:
            env = gymnasium.make(name, **{"render_mode": "rgb_array", **given})
        except gymnasium.error.Error as error:
            raise ConfigurationError(f"Gymnasium environment '{name}': {error}") from error
        return cls(env, skills, replayable=replayable)

    def prepare(self, seed: int) -> None:
        """Reset the environment with a seed."""
        observation, info = self._env.reset(seed=seed)
        self._play = Play(self._env, observation, info)

    def look(self) -> Look:
        """What the environment renders.

        Raises:
            RobotError: if it renders nothing.
        """
        picture = self._env.render()
        if picture is None or isinstance(picture, str):
            kind = "nothing" if picture is None else "text"
            raise RobotError(
                f"render(): expected an array of pixels, got {kind}; make the environment with "
                'render_mode="rgb_array"'
            )
        return picture  # type: ignore[no-any-return]

    def run(self, skill: str, *arguments: str) -> bool | tuple[bool, str]:
        """Run a skill; fails once the episode of the environment is over.

        Raises:
            RobotError: if there is no such skill here.
        """
        if skill not in self._skills:
            known = ", ".join(sorted(self._skills)) or "none"
            raise RobotError(f"expected a skill of {known}, got '{skill}'; name it in robot.py")
        if self._play is None:
            raise RobotError("expected prepare(seed) before a skill")
        if self._play.is_over:
            return False, _OVER
        return self._skills[skill](self._play, *arguments)

    def stop(self) -> None:
        """Close the environment."""
        self._env.close()

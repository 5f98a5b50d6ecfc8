"""The protocol between skillwrapper and a robot or simulator."""

from __future__ import annotations

from typing import Protocol

from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


class Environment(Protocol):
    """A robot or simulator with black-box skills, in Gymnasium's habits.

    ``reset`` comes first; ``execute`` and ``observe`` before it raise ``RobotError``.
    """

    @property
    def domain(self) -> Domain:
        """Types, objects and skills."""
        ...

    @property
    def scene(self) -> Scene:
        """The objects that are present now."""
        ...

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        """Bring the world to a start; the same seed and scene give the same start.

        Args:
            seed: chooses what may differ between starts.
            scene: name of one of the domain's scenes; None for the environment's choice.

        Raises:
            UnknownNameError: if there is no such scene.
        """
        ...

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance to its end, successful or not.

        Raises:
            RobotError: if the robot or simulator itself fails (not the skill).
            UnknownNameError: if there is no such skill instance.
        """
        ...

    def observe(self) -> Observation:
        """What is seen now; changes nothing."""
        ...

    def close(self) -> None:
        """Release what the environment holds; may be called twice."""
        ...

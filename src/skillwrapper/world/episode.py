"""What happened: outcomes, transitions and episodes."""

from __future__ import annotations

from dataclasses import dataclass

from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class Outcome:
    """What one execution of a skill instance brought.

    Attributes:
        success: whether the skill reached its goal, as the robot itself reports.
        observation: what is seen afterwards.
        message: why it failed, for people; never used for learning.
        changed: whether anything changed, where the robot knows; None where it does not.
    """

    success: bool
    observation: Observation
    message: str = ""
    changed: bool | None = None


@dataclass(frozen=True)
class Transition:
    """One execution: what was seen before, what was run, and what came of it.

    Attributes:
        before: observation before the execution.
        instance: the skill instance that was run.
        success: whether it succeeded.
        after: observation after the execution.
        changed: whether anything changed, where the robot knows; None where it does not.
    """

    before: Observation
    instance: SkillInstance
    success: bool
    after: Observation
    changed: bool | None = None


@dataclass(frozen=True)
class Episode:
    """A sequence of transitions after one reset of the environment.

    Attributes:
        scene: the objects that were present.
        seed: the seed given to ``reset``.
        transitions: in the order of execution; each starts where the one before ended.
    """

    scene: Scene
    seed: int
    transitions: tuple[Transition, ...]

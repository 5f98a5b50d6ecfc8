"""What is asked of a model that plans by itself: the next actions towards a goal picture."""

from __future__ import annotations

from dataclasses import dataclass

from skillwrapper.world.domain import Domain
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object


@dataclass(frozen=True)
class ActionQuestion:
    """The next action towards a goal picture (the ViLa baseline)."""

    domain: Domain
    objects: tuple[Object, ...]
    observation: Observation
    goal: Observation
    history: tuple[tuple[SkillInstance, bool], ...]


@dataclass(frozen=True)
class ActionAnswer:
    """The plan from here on; ``done`` and ``impossible`` as the model says.

    Attributes:
        plan: what to do next, in order.
        done: the model says that the goal is reached already; the plan is then empty.
        impossible: the model says that the goal cannot be reached; the plan is then empty.
    """

    plan: tuple[SkillInstance, ...]
    done: bool = False
    impossible: bool = False

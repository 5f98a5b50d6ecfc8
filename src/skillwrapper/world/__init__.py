"""The robot's world as far as it is known from the start: types, objects, skills, pictures."""

from skillwrapper.world.capabilities import (
    Enumerable,
    Judged,
    Replayable,
    Settable,
    Simulable,
    Truthful,
)
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode, Outcome, Transition
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.pictures import encode_png, load_picture, observation_of
from skillwrapper.world.robot import Robot, RobotEnvironment
from skillwrapper.world.scenes import Scene
from skillwrapper.world.simulator import Simulator
from skillwrapper.world.skills import Parameter, Skill, SkillInstance, ground_skills
from skillwrapper.world.types import Object, TypeHierarchy

__all__ = [
    "Domain",
    "Enumerable",
    "Environment",
    "Episode",
    "Judged",
    "Object",
    "Observation",
    "Outcome",
    "Parameter",
    "Picture",
    "Replayable",
    "Robot",
    "RobotEnvironment",
    "Scene",
    "Settable",
    "Simulable",
    "Simulator",
    "Skill",
    "SkillInstance",
    "Transition",
    "Truthful",
    "TypeHierarchy",
    "encode_png",
    "ground_skills",
    "load_domain",
    "load_picture",
    "observation_of",
]

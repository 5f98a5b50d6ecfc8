"""The robot's world as far as it is known from the start: types, objects, skills, pictures."""

from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.environment import EnumerableEnvironment, Environment
from skillwrapper.world.episode import Episode, Outcome, Transition
from skillwrapper.world.observation import Observation, Picture, encode_png, load_picture
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import Parameter, Skill, SkillInstance, ground_skills
from skillwrapper.world.types import Object, TypeHierarchy

__all__ = [
    "Domain",
    "EnumerableEnvironment",
    "Environment",
    "Episode",
    "Object",
    "Observation",
    "Outcome",
    "Parameter",
    "Picture",
    "Scene",
    "Skill",
    "SkillInstance",
    "Transition",
    "TypeHierarchy",
    "encode_png",
    "ground_skills",
    "load_domain",
    "load_picture",
]

"""Black-box skills and their instances."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from skillwrapper.errors import ConfigurationError
from skillwrapper.world.types import Object


@dataclass(frozen=True, order=True)
class Parameter:
    """A typed parameter of a skill.

    Attributes:
        name: unique within the skill, without a question mark.
        type: the type an argument must have.
        role: one sentence on the part the argument plays in the skill.
    """

    name: str
    type: str
    role: str = ""


@dataclass(frozen=True, order=True)
class Skill:
    """A skill the robot can run but knows nothing about (the paper's option).

    Attributes:
        name: e.g. ``"Pick"``.
        parameters: typed parameters.
        description: one sentence on what the skill is meant to do; says nothing of when it works.
    """

    name: str
    parameters: tuple[Parameter, ...]
    description: str = ""

    @property
    def signature(self) -> str:
        """E.g. ``Pick(robot, pickupable)``: the name with its parameter names."""
        return f"{self.name}({', '.join(p.name for p in self.parameters)})"

    def accepts(self, arguments: Sequence[Object]) -> bool:
        """Whether the arguments have the right number and types and are distinct objects (D4)."""
        return (
            len(arguments) == len(self.parameters)
            and len({o.name for o in arguments}) == len(arguments)
            and all(p.type in o.types for p, o in zip(self.parameters, arguments, strict=True))
        )


@dataclass(frozen=True, order=True)
class SkillInstance:
    """A skill with objects as its arguments.

    Attributes:
        skill: name of the skill.
        arguments: names of the objects.
    """

    skill: str
    arguments: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.skill}({', '.join(self.arguments)})"


def parse_skill_instance(text: str) -> SkillInstance:
    """The skill instance that its ``str`` describes, e.g. ``Pick(robot, cup)``.

    Raises:
        ConfigurationError: if the text is no skill with arguments in parentheses.
    """
    match = re.fullmatch(r"\s*([\w-]+)\s*\(([^()]*)\)\s*", text)
    if match is None:
        raise ConfigurationError(f"expected a skill like 'Pick(robot, cup)', got '{text}'")
    arguments = tuple(a.strip() for a in match[2].split(",") if a.strip())
    return SkillInstance(match[1], arguments)


def ground_skills(skills: Iterable[Skill], objects: Sequence[Object]) -> tuple[SkillInstance, ...]:
    """All skill instances over the objects, in the order of skills and objects."""
    return tuple(
        SkillInstance(skill.name, tuple(o.name for o in arguments))
        for skill in skills
        for arguments in itertools.permutations(objects, len(skill.parameters))
        if skill.accepts(arguments)
    )

"""From a written call to a skill instance that exists, or the reason why there is none."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from skillwrapper.vlm.parsing.calls import Call, find_calls
from skillwrapper.vlm.parsing.memory import remembering
from skillwrapper.vlm.parsing.names import NameIndex
from skillwrapper.world.skills import Skill, SkillInstance
from skillwrapper.world.types import Object

_MOST_REORDERED = 6
_LONGEST_NAME = 60
_PIECE = re.compile(r"(?:[^,;:|>-]|-(?![> ]))++")


class Step(NamedTuple):
    """A skill as it was written.

    Attributes:
        skill: its name as written.
        start: where it begins in its line.
        meant: the skill instance that was meant, or why it cannot be told.
    """

    skill: str
    start: int
    meant: SkillInstance | str


@lru_cache(maxsize=16)
def instance_reader(skills: tuple[Skill, ...], objects: tuple[Object, ...]) -> InstanceReader:
    """The reader for some skills and objects; it remembers what it has read."""
    return InstanceReader(skills, objects)


class InstanceReader:
    """Understands written skill instances.

    Args:
        skills: the skills there are.
        objects: the objects of the scene.
    """

    def __init__(self, skills: Sequence[Skill], objects: Sequence[Object]) -> None:
        self._skills = {s.name: s for s in skills}
        self._objects = {o.name: o for o in objects}
        self._skill_names = NameIndex(self._skills)
        self._object_names = NameIndex(self._objects)
        self.steps = remembering(self._steps, len)

    def knows_skill(self, written: str) -> bool:
        """Whether a name is, or comes near, that of a skill."""
        return self._skill_names.find(written) is not None

    def _steps(self, line: str) -> tuple[Step, ...]:
        """The skills in a line in their order.

        Those without arguments may stand there without parentheses, as long as the line holds
        nothing else before them: ``OpenGripper -> Pick(robot, cup)``.
        """
        calls = find_calls(line)
        steps: list[Step] = []
        end, is_list = 0, not line.endswith(":")
        for call in (*calls, None):
            for piece in _PIECE.finditer(line, end, call.start if call else len(line)):
                name = piece.group().strip(" \"'[].")
                is_list = is_list and (not name or self._is_skill(name))
                if name and is_list:
                    steps.append(self._step(Call(name, (), piece.start(), piece.end())))
            if call:
                steps.append(self._step(call))
                end = call.end
        return tuple(steps)

    def _step(self, call: Call) -> Step:
        return Step(call.name, call.start, self._read(call))

    def _is_skill(self, written: str) -> bool:
        return len(written) <= _LONGEST_NAME and self._skill_names.find_exact(written) is not None

    def _read(self, call: Call) -> SkillInstance | str:
        """The skill instance that was meant, or why it cannot be told."""
        name = self._skill_names.find(call.name)
        if name is None:
            return f"{call}: no skill '{call.name}'"
        found = [self._object_names.find_among(readings) for readings in call.readings]
        for readings, object_name in zip(call.readings, found, strict=True):
            if object_name is None:
                return f"{call}: no object '{readings[0] if readings else ''}'"
        chosen = [self._objects[object_name] for object_name in found if object_name is not None]
        return self._fit(self._skills[name], chosen, call)

    def _fit(self, skill: Skill, chosen: list[Object], call: Call) -> SkillInstance | str:
        if skill.accepts(chosen):
            return _instance(skill, chosen)
        if len(chosen) > len(skill.parameters):
            return f"{call}: expected {len(skill.parameters)} arguments, got {len(chosen)}"
        fits = {_instance(skill, arguments) for arguments in self._arrangements(skill, chosen)}
        if len(fits) == 1:
            return fits.pop()
        if len({o.name for o in chosen}) < len(chosen):
            return f"{call}: expected different objects"
        if len(chosen) < len(skill.parameters):
            return f"{call}: expected {len(skill.parameters)} arguments, got {len(chosen)}"
        expected = ", ".join(p.type for p in skill.parameters)
        return f"{call}: expected arguments of the types ({expected})"

    def _arrangements(self, skill: Skill, chosen: list[Object]) -> list[tuple[Object, ...]]:
        """Other orders, or with arguments left out that can only be one object."""
        size = len(skill.parameters)
        if size > _MOST_REORDERED:
            return []
        if len(chosen) == size:
            return [order for order in itertools.permutations(chosen) if skill.accepts(order)]
        completed = []
        for places in itertools.combinations(range(size), len(chosen)):
            given = dict(zip(places, chosen, strict=True))
            arguments = [given.get(i) or self._only(p.type) for i, p in enumerate(skill.parameters)]
            present = tuple(o for o in arguments if o is not None)
            if len(present) == size and skill.accepts(present):
                completed.append(present)
        return completed

    def _only(self, type_name: str) -> Object | None:
        fitting = [o for o in self._objects.values() if type_name in o.types]
        return fitting[0] if len(fitting) == 1 else None


def _instance(skill: Skill, arguments: Sequence[Object]) -> SkillInstance:
    return SkillInstance(skill.name, tuple(o.name for o in arguments))

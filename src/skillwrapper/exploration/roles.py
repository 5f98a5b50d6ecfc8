"""What was last done with every object: history as far as it may matter for what works next.

Where no predicate tells two states apart, what was done with the objects may: an opened box was
the argument of the last successful Open.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.world.domain import Domain
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance, ground_skills

UNTOUCHED = -1
"""The role of an object with which nothing succeeded in this episode."""
_KEEPS = -2

Kind = tuple[str, tuple[tuple[str, ...], ...]]
"""A skill and the most specific types of its arguments."""

Roles = NDArray[np.intp]
"""The role of every object of a scene, by number (..., objects)."""


class RoleNumbers:
    """Numbers the roles that objects play: skill, position, and types of the other arguments."""

    def __init__(self) -> None:
        self._number: dict[tuple[str, int, tuple[tuple[str, ...], ...]], int] = {}

    def number(self, skill: str, position: int, others: Sequence[tuple[str, ...]]) -> int:
        """The number of a role."""
        return self._number.setdefault((skill, position, tuple(others)), len(self._number))

    @property
    def kinds(self) -> NDArray[np.intp]:
        """For every role a number of its skill and position alone; the last one for UNTOUCHED."""
        kinds: dict[tuple[str, int], int] = {}
        found = [kinds.setdefault(role[:2], len(kinds)) for role in self._number]
        return np.array([*found, UNTOUCHED], dtype=np.intp)


class SceneRoles:
    """The roles that objects of a scene play in skill instances.

    Args:
        domain: types and skills.
        scene: the objects.
        numbers: numbers of the roles, shared by all scenes.

    Attributes:
        instances: all skill instances of the scene.
        places: for every instance the numbers of its arguments; not of those that every instance
            of every skill has, in the same place, as it may be with the robot itself.
    """

    def __init__(self, domain: Domain, scene: Scene, numbers: RoleNumbers) -> None:
        self.instances = ground_skills(domain.skills, scene.objects)
        place = {o.name: n for n, o in enumerate(scene.objects)}
        types = {o.name: domain.types.most_specific(o.types) for o in scene.objects}
        self.kinds: list[Kind] = [
            (i.skill, tuple(types[name] for name in i.arguments)) for i in self.instances
        ]
        common = _everywhere(self.instances)
        self.places: list[NDArray[np.intp]] = []
        self._given: Roles = np.full((len(self.instances), len(place)), _KEEPS, dtype=np.intp)
        for number, instance in enumerate(self.instances):
            own = [name for name in instance.arguments if name not in common]
            self.places.append(np.array([place[name] for name in own], dtype=np.intp))
            for name in own:
                others = [types[other] for other in own if other != name]
                position = instance.arguments.index(name)
                role = numbers.number(instance.skill, position, others)
                self._given[number, place[name]] = role

    @cached_property
    def number(self) -> dict[SkillInstance, int]:
        """The number of every skill instance."""
        return {instance: number for number, instance in enumerate(self.instances)}

    @property
    def at_start(self) -> Roles:
        """Nothing was done with any object (objects,)."""
        return np.full(self._given.shape[1], UNTOUCHED, dtype=np.intp)

    def after(self, roles: Roles, instance: int) -> Roles:
        """The roles (objects,) after a success of a skill instance."""
        given = self._given[instance]
        return np.where(given == _KEEPS, roles, given)

    def signature(self, roles: Roles, instance: int) -> tuple[int, ...]:
        """The roles of the arguments of an instance, where the roles are those (objects,)."""
        return tuple(roles[self.places[instance]].tolist())


def _everywhere(instances: Sequence[SkillInstance]) -> frozenset[str]:
    """The objects that are the same argument of all instances of a skill, for every skill."""
    fixed: dict[str, set[tuple[int, str]]] = {}
    for instance in instances:
        arguments = set(enumerate(instance.arguments))
        fixed[instance.skill] = fixed.get(instance.skill, arguments) & arguments
    names = ({name for _, name in of_skill} for of_skill in fixed.values())
    return frozenset(set.intersection(*names)) if fixed else frozenset()

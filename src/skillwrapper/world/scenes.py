"""Scenes: which of a domain's objects are there together."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from skillwrapper.world.types import Object

DEFAULT_SCENE = "default"
"""Name of the scene with all objects, which a domain has that declares none."""


@dataclass(frozen=True, order=True)
class Scene:
    """A named set of objects (docs/semantics.md D19); labels and plans are over these only.

    Attributes:
        name: unique within a domain, e.g. ``"bench"``.
        objects: what is present, each once, in the domain's order.
    """

    name: str
    objects: tuple[Object, ...]

    @classmethod
    def of(cls, name: str, present: Iterable[str], known: Iterable[Object]) -> Scene:
        """The scene of the known objects with these names, in the order of the known ones."""
        names = frozenset(present)
        return cls(name, tuple(o for o in known if o.name in names))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the objects."""
        return tuple(o.name for o in self.objects)

"""Facts: the smallest things that can be seen in a picture, each rightly or wrongly as a whole.

Whatever is said of a picture, in whatever words, rests on these.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from skillwrapper.embedded.scene_graph import Box, SceneGraph

_NEAR = 0.22
_SAME_LINE = 0.05
_EDGE = 0.12


class Sort(StrEnum):
    """What sort of fact."""

    RELATION = "relation"
    """A thing stands in a relation to another one."""
    RELATION_TO_KIND = "relation to kind"
    """A thing stands in a relation to scenery of a kind, whichever."""
    VACANCY = "vacancy"
    """Nothing stands in a relation to a thing: nothing is on it, in it, held by it."""
    ATTRIBUTE = "attribute"
    """A thing has an attribute."""
    CONDITION = "condition"
    """Something is the case in the picture as a whole."""
    PLACE = "place"
    """Where in the picture a thing is, by itself or beside another."""


@dataclass(frozen=True)
class Fact:
    """Something that is the case in a picture, or is not.

    Attributes:
        sort: what sort of fact.
        name: of the relation, attribute, condition or place.
        things: names of the things concerned; for ``RELATION_TO_KIND`` a thing and a kind.
    """

    sort: Sort
    name: str
    things: tuple[str, ...] = ()

    @property
    def canonical(self) -> Fact:
        """The fact in which it is the same glance: ``a`` left of ``b``, ``b`` right of ``a``."""
        if self.sort is Sort.PLACE:
            return Fact(self.sort, self.name, tuple(sorted(self.things)))
        return self

    def kinds(self, graph: SceneGraph) -> tuple[str, ...]:
        """Kinds of the things concerned."""
        if self.sort is Sort.RELATION_TO_KIND:
            return graph.kind(self.things[0]), self.things[1]
        return tuple(graph.kind(name) for name in self.things)

    def is_looked_for(self, graph: SceneGraph) -> bool:
        """Whether anybody would look for it: that a lamp is no ripe fruit needs no glance."""
        if self.sort is Sort.ATTRIBUTE:
            return self.name in graph.attributes.get(self.things[0], ())
        return True

    def truth(self, graph: SceneGraph, size: tuple[int, int]) -> bool:
        """Whether it is the case.

        Args:
            graph: what the picture shows.
            size: width and height of the picture, in pixels.
        """
        if self.sort is Sort.PLACE:
            boxes = [graph.thing_by_name[name].box for name in self.things]
            is_so = _PLACES[self.name](*boxes, size)
            return is_so and not (self.name == "near" and _are_related(graph, self.things))
        return _TRUTHS[self.sort](graph, self.name, self.things)


def _related_to_kind(graph: SceneGraph, relation: str, things: tuple[str, ...]) -> bool:
    name, kind = things
    return any(graph.related(relation, name, other) for other in graph.names(kind))


def _are_related(graph: SceneGraph, things: tuple[str, ...]) -> bool:
    """Whether one is on, in, held by ... the other: nobody calls that being next to it."""
    a, b = things
    return any((a, b) in pairs or (b, a) in pairs for pairs in graph.relations.values())


def _vacant(graph: SceneGraph, relation: str, things: tuple[str, ...]) -> bool:
    return all(second != things[0] for _, second in graph.relations.get(relation, ()))


_TRUTHS: Mapping[Sort, Callable[[SceneGraph, str, tuple[str, ...]], bool]] = MappingProxyType(
    {
        Sort.RELATION: lambda graph, name, things: graph.related(name, *things),
        Sort.RELATION_TO_KIND: _related_to_kind,
        Sort.VACANCY: _vacant,
        Sort.ATTRIBUTE: lambda graph, name, things: graph.has(things[0], name),
        Sort.CONDITION: lambda graph, name, _: graph.conditions.get(name, False),
    }
)

Size = tuple[int, int]


def _nearness(a: Box, b: Box, size: Size) -> bool:
    return math.dist(a.centre, b.centre) / size[0] < _NEAR


def _farness(a: Box, b: Box, size: Size) -> bool:
    return not _nearness(a, b, size)


def _is_central(a: Box, size: Size) -> bool:
    return math.dist(a.centre, (size[0] / 2, size[1] / 2)) < size[0] / 4


def _is_at_edge(a: Box, size: Size) -> bool:
    inside = (min(at, end - at) / end for at, end in zip(a.centre, size, strict=True))
    return min(inside) < _EDGE


def _on_one_line(axis: int) -> Callable[..., bool]:
    def test(a: Box, b: Box, size: Size) -> bool:
        return abs(a.centre[axis] - b.centre[axis]) / size[axis] < _SAME_LINE

    return test


_PLACES: Mapping[str, Callable[..., bool]] = MappingProxyType(
    {
        "left_of": lambda a, b, _: a.centre[0] < b.centre[0],
        "higher": lambda a, b, _: a.centre[1] < b.centre[1],
        "near": _nearness,
        "far": _farness,
        "same_row": _on_one_line(1),
        "same_column": _on_one_line(0),
        "larger": lambda a, b, _: a.width * a.height > b.width * b.height,
        "left_half": lambda a, size: a.centre[0] < size[0] / 2,
        "upper_half": lambda a, size: a.centre[1] < size[1] / 2,
        "central": _is_central,
        "at_edge": _is_at_edge,
        "wide": lambda a, _: a.width > a.height,
    }
)
"""Tests of the boxes of one or two things in a picture of a size."""

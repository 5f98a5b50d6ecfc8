"""A scene graph: what a scene reader found in one picture, and nothing of what it means."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any

from skillwrapper.errors import ConfigurationError

Pairs = AbstractSet[tuple[str, str]]


@dataclass(frozen=True, order=True)
class Box:
    """A rectangle in the picture, in pixels from its upper left corner.

    Attributes:
        left: first column.
        top: first row.
        right: one past the last column.
        bottom: one past the last row.
    """

    left: int
    top: int
    right: int
    bottom: int

    @property
    def centre(self) -> tuple[float, float]:
        """Column and row of the middle."""
        return (self.left + self.right) / 2, (self.top + self.bottom) / 2

    @property
    def width(self) -> int:
        """Columns."""
        return self.right - self.left

    @property
    def height(self) -> int:
        """Rows."""
        return self.bottom - self.top


@dataclass(frozen=True)
class Thing:
    """Something that is seen.

    Attributes:
        name: the domain's name of the object, e.g. ``"cup"``; for scenery any name.
        kind: what it looks like, in the reader's own words: ``"robot"``, ``"shelf"``, ...
        box: where it is seen.
        scenery: whether it is no object of the domain and so has no name that anybody knows:
            one of a row of tables, the floor.
    """

    name: str
    kind: str
    box: Box
    scenery: bool = False


@dataclass(frozen=True)
class Outline:
    """What pictures of one world can show, whatever is the case in them.

    Attributes:
        relations: names of the relations.
        attributes: names of the attributes, each with the kinds of things that may have it.
        conditions: names of the conditions.
        things: name, kind and whether it is scenery of every thing.
    """

    relations: tuple[str, ...]
    attributes: tuple[tuple[str, frozenset[str]], ...]
    conditions: tuple[str, ...]
    things: tuple[tuple[str, str, bool], ...]

    def named(self, kind: str) -> tuple[str, ...]:
        """Names of the things of a kind that are no scenery."""
        return tuple(name for name, k, scenery in self.things if k == kind and not scenery)

    def is_scenery(self, kind: str) -> bool:
        """Whether all things of a kind are scenery."""
        return all(scenery for _, k, scenery in self.things if k == kind)


def _empty() -> Mapping[str, Any]:
    return MappingProxyType({})


@dataclass(frozen=True)
class SceneGraph:
    """What is where in one picture. Only what can be seen, only direct relations.

    A reader names all that it looks for, also what is not the case just now: a relation in which
    nothing stands, an attribute that nothing has.

    Attributes:
        things: everything seen.
        relations: for every relation that is looked for, the pairs that stand in it:
            ``{"on": {("cup", "shelf")}, "held": {("spoon", "robot")}, "in": set()}``. ``on``
            (what touches what lies directly beneath it), ``held`` (by whom) and ``in`` are
            spoken of without further words; others may have any name.
        attributes: for every thing, whether it has each attribute that is looked for in it:
            ``{"drawer": {"open": True}}``.
        conditions: what is true or false of the whole picture: ``{"dark": False}``.

    Raises:
        ConfigurationError: if a relation or an attribute is said of something that is not seen.
    """

    things: tuple[Thing, ...]
    relations: Mapping[str, Pairs] = field(default_factory=_empty)
    attributes: Mapping[str, Mapping[str, bool]] = field(default_factory=_empty)
    conditions: Mapping[str, bool] = field(default_factory=_empty)

    def __post_init__(self) -> None:
        spoken_of = {n for pairs in self.relations.values() for pair in pairs for n in pair}
        unseen = sorted((spoken_of | set(self.attributes)) - set(self.thing_by_name))
        if unseen:
            raise ConfigurationError(
                f"expected relations and attributes of things that are seen "
                f"({', '.join(self.thing_by_name) or 'none'}), got '{unseen[0]}'; "
                f"mend the scene reader"
            )

    @cached_property
    def thing_by_name(self) -> Mapping[str, Thing]:
        """Things by their names."""
        return {thing.name: thing for thing in self.things}

    @cached_property
    def outline(self) -> Outline:
        """What pictures like this one can show."""
        kinds: dict[str, set[str]] = {}
        for thing, values in self.attributes.items():
            for attribute in values:
                kinds.setdefault(attribute, set()).add(self.kind(thing))
        return Outline(
            tuple(sorted(self.relations)),
            tuple((name, frozenset(kinds[name])) for name in sorted(kinds)),
            tuple(sorted(self.conditions)),
            tuple(sorted((thing.name, thing.kind, thing.scenery) for thing in self.things)),
        )

    def __contains__(self, name: str) -> bool:
        return name in self.thing_by_name

    def names(self, kind: str) -> tuple[str, ...]:
        """Names of all things of a kind, in the order of ``things``."""
        return tuple(thing.name for thing in self.things if thing.kind == kind)

    def kind(self, name: str) -> str:
        """The kind of a thing; empty if it is not seen."""
        return self.thing_by_name[name].kind if name in self else ""

    def related(self, relation: str, first: str, second: str) -> bool:
        """Whether the first thing stands in a relation to the second."""
        return (first, second) in self.relations.get(relation, ())

    def has(self, name: str, attribute: str) -> bool:
        """Whether a thing has an attribute; one that is not looked for in it, it has not."""
        return self.attributes.get(name, {}).get(attribute, False)

    def chain(self, relation: str, name: str) -> Iterator[str]:
        """From thing to thing along a relation: what carries a thing, what carries that, ..."""
        passed = {name}
        following = dict(sorted(self.relations.get(relation, ())))
        while (name := following.get(name, name)) not in passed:
            passed.add(name)
            yield name

"""A scene: what a scene reader found in one picture, and nothing of what it means."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType


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
        name: the domain's name of the object (``"patty"``), or for furniture that is no object
            of the domain, kind and number from left to right, top to bottom (``"table_1"``).
        kind: what it looks like: ``"robot"``, ``"item"``, ``"station"``, ``"table"``, ...
        box: where it is seen.
    """

    name: str
    kind: str
    box: Box


def _nothing() -> Mapping[str, str]:
    return MappingProxyType({})


def _no_attributes() -> Mapping[str, frozenset[str]]:
    return MappingProxyType({})


@dataclass(frozen=True)
class Scene:
    """What is where in one picture. Only what can be seen, only direct relations.

    Attributes:
        things: everything seen, robot first, then furniture, then items.
        on: for every thing that lies on another, the one it lies on *directly*: another item,
            a station or a table (``{"topbun": "patty", "patty": "stove"}``).
        held: for every thing that a robot holds, the robot (``{"lettuce": "robot"}``); what is
            held lies on nothing, but other things may lie on it.
        attributes: what is seen of a thing itself (``{"lettuce": {"cut"}}``); a thing without
            an entry has none.
    """

    things: tuple[Thing, ...]
    on: Mapping[str, str] = field(default_factory=_nothing)
    held: Mapping[str, str] = field(default_factory=_nothing)
    attributes: Mapping[str, frozenset[str]] = field(default_factory=_no_attributes)

    @cached_property
    def thing_by_name(self) -> Mapping[str, Thing]:
        """Things by their names."""
        return {thing.name: thing for thing in self.things}

    def __contains__(self, name: str) -> bool:
        return name in self.thing_by_name

    def names(self, kind: str) -> tuple[str, ...]:
        """Names of all things of a kind, in the order of ``things``."""
        return tuple(thing.name for thing in self.things if thing.kind == kind)

    def kind(self, name: str) -> str:
        """The kind of a thing; empty if it is not seen."""
        return self.thing_by_name[name].kind if name in self else ""

    def is_on(self, upper: str, lower: str) -> bool:
        """Whether ``upper`` lies directly on ``lower``."""
        return self.on.get(upper) == lower

    def directly_on(self, name: str) -> tuple[str, ...]:
        """What lies directly on a thing; empty if nothing does."""
        return tuple(upper for upper, lower in sorted(self.on.items()) if lower == name)

    def is_clear(self, name: str) -> bool:
        """Whether nothing lies directly on a thing."""
        return name not in self.on.values()

    def supports(self, name: str) -> Iterator[str]:
        """What a thing rests on, from directly beneath it down to the furniture."""
        below = self.on.get(name)
        while below is not None:
            yield below
            below = self.on.get(below)

    def is_above(self, upper: str, lower: str) -> bool:
        """Whether ``upper`` rests on ``lower``, directly or with things between."""
        return lower in self.supports(upper)

    def resting_place(self, name: str) -> str | None:
        """The lowest thing beneath (station, table, held item); None if it lies on nothing."""
        chain = tuple(self.supports(name))
        return chain[-1] if chain else None

    def is_held(self, name: str) -> bool:
        """Whether any robot holds the thing itself."""
        return name in self.held

    def held_by(self, robot: str) -> tuple[str, ...]:
        """What a robot holds; empty if its hand is empty."""
        return tuple(name for name, holder in sorted(self.held.items()) if holder == robot)

    def has(self, name: str, attribute: str) -> bool:
        """Whether a thing is seen to have an attribute."""
        return attribute in self.attributes.get(name, frozenset())

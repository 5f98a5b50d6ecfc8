"""A world: rules over true facts, and concepts in which a reader speaks of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count

import numpy as np

from skillwrapper.world import (
    Domain,
    Object,
    Parameter,
    Picture,
    Scene,
    Simulator,
    Skill,
    SkillInstance,
    TypeHierarchy,
)
from skillwrapper.world.pictures import picture_of

Fact = tuple[str, ...]
Facts = frozenset[Fact]


@dataclass(frozen=True)
class Wording:
    """How a concept is put: a name, which of its things stands in which place, and its meaning.

    Attributes:
        name: of the predicate.
        order: the places of the concept's things, as the predicate has them.
        meaning: a sentence, with the number of a thing in braces for its type.
    """

    name: str
    order: tuple[int, ...]
    meaning: str


@dataclass(frozen=True, eq=False)
class Concept:
    """Something that can be told of a picture.

    Attributes:
        types: of the things that it is about.
        holds: from what is true and the names of things to whether it is so.
        wordings: in how many ways it is put.
        general: the relation of which it is a case, if it is one.
        is_telling: whether it is about the state, and not about the picture.
    """

    types: tuple[str, ...]
    holds: Callable[..., bool]
    wordings: tuple[Wording, ...]
    general: Concept | None = None
    is_telling: bool = True


def concept(
    types: str,
    holds: Callable[..., bool] | str,
    *wordings: str,
    general: Concept | None = None,
    is_telling: bool = True,
) -> Concept:
    """A concept from ``"hand cup"``, a fact's name, and ``"has(0, 1): the {0} has the {1}."``."""
    if isinstance(holds, str):
        holds = _is_fact(holds)
    found = []
    for text in wordings:
        head, meaning = text.split(":", 1)
        name, order = head.rstrip(")").split("(")
        places = tuple(int(place) for place in order.replace(",", " ").split())
        found.append(Wording(name.strip(), places, meaning.strip()))
    return Concept(tuple(types.split()), holds, tuple(found), general, is_telling)


def _is_fact(name: str) -> Callable[..., bool]:
    return lambda facts, *things: (name, *things) in facts


def make_domain(
    name: str,
    types: Mapping[str, str],
    objects: Mapping[str, str],
    skills: Mapping[str, str],
    scenes: Mapping[str, str] | None = None,
    *,
    failures_change_nothing: bool = True,
    resets_restore_state: bool = True,
) -> Domain:
    """A domain from ``{"cup": "item"}``, ``{"mug": "cup"}``, ``{"Take": "hand item"}``."""
    hierarchy = TypeHierarchy({t: tuple(parents.split()) for t, parents in types.items()})
    things = tuple(
        Object(o, tuple(sorted(hierarchy.closure(own.split())))) for o, own in objects.items()
    )
    return Domain(
        name=name,
        agent="A robot.",
        description=f"The {name.replace('_', ' ')}, seen by a camera.",
        types=hierarchy,
        objects=things,
        skills=tuple(
            Skill(s, tuple(Parameter(_place(own.split(), n), t) for n, t in enumerate(own.split())))
            for s, own in skills.items()
        ),
        declared_scenes=tuple(
            Scene.of(scene, own.split(), things) for scene, own in (scenes or {}).items()
        ),
        failures_change_nothing=failures_change_nothing,
        resets_restore_state=resets_restore_state,
    )


def _place(types: Sequence[str], number: int) -> str:
    name = types[number]
    return name if types.count(name) == 1 else f"{name}_{types[: number + 1].count(name)}"


class World(Simulator[Facts]):
    """A world whose states are the facts that are true; no two of its pictures are alike.

    Attributes:
        concepts: all that a reader has words for.
        glimpses: what is true in every picture so far, by its key, with the picture's number.
    """

    replayable = False
    make: Domain

    def __init__(self) -> None:
        super().__init__(self.make)
        self._number = count(1)
        self.glimpses: dict[str, tuple[Facts, int]] = {}

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        """What is true after a skill; None if it fails."""
        raise NotImplementedError

    def own_concepts(self) -> Iterable[Concept]:
        """What can be told of a picture of this world."""
        raise NotImplementedError

    def obstacle(self, state: Facts, instance: SkillInstance) -> str | None:
        works = self.after(state, instance.skill, *instance.arguments) is not None
        return None if works else "it did not work"

    def effect(self, state: Facts, instance: SkillInstance) -> Facts:
        after = self.after(state, instance.skill, *instance.arguments)
        return state if after is None else after

    def draw(self, state: Facts, layout: int) -> Picture:
        number = next(self._number)
        pixels = np.frombuffer(number.to_bytes(48, "big"), dtype=np.uint8).reshape(4, 4, 3)
        picture = picture_of(pixels)
        self.glimpses[picture.sha256] = state, number
        return picture

    @cached_property
    def concepts(self) -> tuple[Concept, ...]:
        return (*self.own_concepts(), *_chance_concepts(self.domain))


def _chance_concepts(domain: Domain) -> Iterator[Concept]:
    """What can be told of a picture and says nothing of the state."""
    yield concept("", _by_chance, "camera_is_left(): the camera looks from the left.",
                  "shadow_is_long(): the shadow is long.", is_telling=False)  # fmt: skip
    types = dict.fromkeys(p.type for s in domain.skills for p in s.parameters)
    for name in types:
        yield concept(name, _by_chance, f"{name}_in_left_half(0): the {{0}} is in the left half.",
                      is_telling=False)  # fmt: skip
    for one, other in zip(types, list(types)[1:], strict=False):
        yield concept(f"{one} {other}", _by_chance, f"{one}_near_{other}(0, 1): the {{0}} is near"
                      " the {1}.", is_telling=False)  # fmt: skip


def _by_chance(facts: Facts, *things: str) -> bool:
    number = next(int(f[1]) for f in facts if f[0] == "picture")
    seed = sum(map(ord, "".join(things))) + 7919 * number
    return bool(np.random.default_rng(seed).random() < 0.5)


def where(facts: Facts, name: str, thing: str) -> str:
    """The other one of a relation that a thing stands in; empty if it stands in none."""
    return next((f[2] for f in facts if f[0] == name and f[1] == thing), "")


def move(facts: Facts, name: str, thing: str, place: str) -> Facts:
    """The same with a thing in another place."""
    return frozenset(f for f in facts if f[:2] != (name, thing)) | {(name, thing, place)}

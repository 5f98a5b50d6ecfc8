"""Making the embedded model worse on purpose, in the ways real models are."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.concepts import Concept
from skillwrapper.embedded.scene import Scene
from skillwrapper.embedded.sight import Sight
from skillwrapper.errors import UnknownNameError


@dataclass(frozen=True)
class ErrorRates:
    """How often a concept is misjudged, over all pictures.

    Attributes:
        false_positive: share of the false ones that are taken to be true, 0 to 1.
        false_negative: share of the true ones that are taken to be false, 0 to 1.
    """

    false_positive: float = 0.0
    false_negative: float = 0.0


@dataclass(frozen=True)
class Confusion:
    """Two things that are taken for each other in tall stacks.

    Attributes:
        first: name of one thing.
        second: name of the other.
        height: how many things such a stack has at least.
        rate: share of the pictures with errors in which it happens.
    """

    first: str
    second: str
    height: int
    rate: float


@dataclass(frozen=True)
class NoiseProfile:
    """What goes wrong and how often.

    Errors of judgement depend on the picture and the statement alone: who asks again gets the
    same error. Spoilt replies and timeouts depend on the prompt.

    Attributes:
        name: of the profile.
        rates: error rates by the idea of a concept, e.g. ``hand_empty``.
        other_rates: error rates of all other ideas.
        clean_pictures: share of pictures without any error of judgement; the errors are in
            the others, as often as the rates over all pictures ask for.
        confusions: things taken for each other.
        malformed: share of replies that break off or are nonsense.
        wrong_names: share of replies in which a name is misspelt.
        timeouts: share of calls that time out; they are repeated.
    """

    name: str
    rates: Mapping[str, ErrorRates] = field(default_factory=dict)
    other_rates: ErrorRates = field(default_factory=ErrorRates)
    clean_pictures: float = 0.0
    confusions: tuple[Confusion, ...] = ()
    malformed: float = 0.0
    wrong_names: float = 0.0
    timeouts: float = 0.0


NO_NOISE = NoiseProfile("none")

# Counts of wrong readings that were measured on a real model (DESIGN.md section 6): 138
# pictures, false positives and false negatives over all readings. How many of the readings were
# true was recorded for cut (39) and cooked (37). For the others it is taken from the share of
# true ones in all reachable states: 85 of 138 for an empty hand, 53 of 552 for holding, 333 of
# 552 for clear, 219 of 1656 for stacked, 166 of 1104 for on a station. For stacked, 5 of the 18
# and 5 of the 22 errors are left to the exchanged buns.
_GPT5 = NoiseProfile(
    name="gpt5",
    rates=MappingProxyType(
        {
            "hand_empty": ErrorRates(0.0, 1 / 85),
            "holding": ErrorRates(1 / 499, 0.0),
            "clear": ErrorRates(10 / 219, 6 / 333),
            "on": ErrorRates(13 / 1437, 17 / 219),
            "on_station": ErrorRates(12 / 938, 5 / 166),
            "cut": ErrorRates(11 / 99, 1 / 39),
            "cooked": ErrorRates(28 / 101, 0.0),
        }
    ),
    clean_pictures=90 / 138,
    confusions=(Confusion("topbun", "bottombun", 3, 0.3),),
)

PROFILES: Mapping[str, NoiseProfile] = MappingProxyType({p.name: p for p in (NO_NOISE, _GPT5)})
"""The profiles that can be chosen by name."""


def noise_profile(name: str) -> NoiseProfile:
    """The profile of a name, or of a rate such as ``0.05``: every judgement errs so often.

    Raises:
        UnknownNameError: if there is none.
    """
    if re.fullmatch(r"0?\.\d+", name):
        return NoiseProfile(name, other_rates=ErrorRates(float(name), float(name)))
    if name not in PROFILES:
        raise UnknownNameError("noise profile", name, PROFILES)
    return PROFILES[name]


class Judgement:
    """Judges concepts, wrongly as often as the profile says.

    Args:
        profile: what goes wrong.
        seed: models with different seeds make different errors.
    """

    def __init__(self, profile: NoiseProfile, seed: int) -> None:
        self._profile, self._seed = profile, seed

    def truth(self, concept: Concept, sight: Sight, arguments: tuple[str, ...]) -> bool | None:
        """Whether a concept holds, as this model sees it."""
        if self._profile is NO_NOISE or self._is_clean(sight):
            return concept.truth(sight, arguments)
        truth = concept.truth(self._confused(sight), arguments)
        if truth is None:
            return None
        idea = truth is concept.positive
        wrong = self._errs(concept.idea, idea, sight, arguments)
        return truth is not wrong

    def _is_clean(self, sight: Sight) -> bool:
        share = self._profile.clean_pictures
        return Chance(self._seed, "clean", sight.key).happens(share)

    def _errs(self, idea: str, holds: bool, sight: Sight, arguments: tuple[str, ...]) -> bool:
        rates = self._profile.rates.get(idea, self._profile.other_rates)
        overall = rates.false_negative if holds else rates.false_positive
        rate = min(1.0, overall / max(1e-9, 1 - self._profile.clean_pictures))
        return Chance(self._seed, "error", sight.key, idea, *arguments).happens(rate)

    def _confused(self, sight: Sight) -> Sight:
        for confusion in self._profile.confusions:
            chance = Chance(self._seed, "confusion", sight.key, confusion.first, confusion.second)
            if chance.happens(confusion.rate) and _is_tall(sight.scene, confusion):
                scene = exchanged(sight.scene, confusion.first, confusion.second)
                sight = replace(sight, scene=scene)
        return sight


def _is_tall(scene: Scene, confusion: Confusion) -> bool:
    """Whether both are part of one stack that is tall enough."""
    stacks = [
        (item, *(n for n in scene.supports(item) if scene.kind(n) == "item"))
        for item in scene.names("item")
    ]
    return any(
        len(stack) >= confusion.height and {confusion.first, confusion.second} <= set(stack)
        for stack in stacks
    )


def exchanged(scene: Scene, first: str, second: str) -> Scene:
    """The scene with two things taken for each other."""
    swap = {first: second, second: first}

    def name_of(name: str) -> str:
        return swap.get(name, name)

    return Scene(
        things=tuple(replace(thing, name=name_of(thing.name)) for thing in scene.things),
        on={name_of(upper): name_of(lower) for upper, lower in scene.on.items()},
        held={name_of(item): robot for item, robot in scene.held.items()},
        attributes={name_of(item): found for item, found in scene.attributes.items()},
    )

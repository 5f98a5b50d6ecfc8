"""Misreading pictures: which facts of a picture seem to be otherwise than they are.

Errors belong to facts: a fact that is misread in a picture is misread in every wording, and all
that is said of the picture rests on the facts as they seem.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.facts import Fact
from skillwrapper.embedded.noise import NoiseProfile
from skillwrapper.embedded.scene_graph import SceneGraph
from skillwrapper.embedded.sight import Sight

_STACKED = "on"


class Misreading:
    """Decides which facts are misread: by the picture and the fact, not by the words.

    Args:
        profile: what goes wrong.
        seed: models with different seeds make different errors.
        look_alikes: pairs of things, by name, that may be taken for each other.
    """

    def __init__(
        self, profile: NoiseProfile, seed: int, look_alikes: Sequence[tuple[str, str]] = ()
    ) -> None:
        self._profile, self._seed, self._look_alikes = profile, seed, tuple(look_alikes)
        self._rates = lru_cache(maxsize=None)(profile.rates)

    def of(self, sight: Sight, asked: str) -> Sight:
        """What a picture seems to show.

        Args:
            sight: what it shows.
            asked: the question; it only matters to errors that are not due to the picture.
        """
        clean = Chance(self._seed, "clean", sight.key)
        if clean.happens(self._profile.clean_pictures):
            return sight
        return _MisreadSight(self._confused(sight), sight.size, sight.key, self, asked)

    def errs(self, fact: Fact, sight: Sight, asked: str) -> bool:
        """Whether a fact is taken for its opposite."""
        if not fact.is_looked_for(sight.graph):
            return False
        fact = fact.canonical
        rates = self._rates(fact.sort, fact.name, fact.kinds(sight.graph))
        holds = fact.truth(sight.graph, sight.size)
        rate = rates.false_negative if holds else rates.false_positive
        rate = min(1.0, rate / (1 - self._profile.clean_pictures))
        which = (str(self._seed), sight.key, fact.sort, fact.name, *fact.things)
        due = Chance("due", *which).happens(self._profile.due_to_picture)
        return Chance("error", *which, *(() if due else (asked,))).happens(rate)

    def _confused(self, sight: Sight) -> SceneGraph:
        graph, exchange = sight.graph, self._profile.exchange
        for first, second in self._look_alikes:
            chance = Chance(self._seed, "exchange", sight.key, first, second)
            if chance.happens(exchange.rate) and _in_one_stack(
                graph, first, second, exchange.height
            ):
                graph = exchanged(graph, first, second)
        return graph


@dataclass(frozen=True)
class _MisreadSight(Sight):
    """What a picture seems to show."""

    misreading: Misreading
    asked: str

    def holds(self, fact: Fact) -> bool:
        return super().holds(fact) is not self.misreading.errs(fact, self, self.asked)


def exchanged(graph: SceneGraph, first: str, second: str) -> SceneGraph:
    """The scene with two things taken for each other."""
    swap = {first: second, second: first}

    def name_of(name: str) -> str:
        return swap.get(name, name)

    return SceneGraph(
        things=tuple(replace(thing, name=name_of(thing.name)) for thing in graph.things),
        relations={
            relation: {(name_of(a), name_of(b)) for a, b in pairs}
            for relation, pairs in graph.relations.items()
        },
        attributes={name_of(name): values for name, values in graph.attributes.items()},
        conditions=graph.conditions,
    )


def _in_one_stack(graph: SceneGraph, first: str, second: str, height: int) -> bool:
    """Whether both are part of one stack of things of their kind that is tall enough."""
    if first not in graph or second not in graph:
        return False
    kind = graph.kind(first)
    stacks = (
        {top, *(name for name in graph.chain(_STACKED, top) if graph.kind(name) == kind)}
        for top in graph.names(kind)
    )
    return any(len(stack) >= height and {first, second} <= stack for stack in stacks)

"""Pictures of the burger kitchen for tests, with what is true in them."""

from __future__ import annotations

import random
from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.scene_reader import read_burger_scene
from skillwrapper.domains.burger.states import HAND, ITEMS, TABLE, BurgerState
from skillwrapper.domains.discovery import find_domain
from skillwrapper.embedded import EmbeddedModel, NoiseProfile, noise_profile
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.scene_graph import Box, SceneGraph, Thing
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world import Observation, SkillInstance, Transition

EXPERT = (
    Predicate("hand_empty", ("robot",), "The robot holds nothing."),
    Predicate("holding", ("robot", "pickupable"), "The robot holds the ingredient."),
    Predicate("station_empty", ("station",), "No ingredient lies on the station."),
    Predicate("on_station", ("pickupable", "station"), "It lies directly on the station."),
    Predicate("stacked_on", ("pickupable", "pickupable"), "The first lies on the second."),
    Predicate("on_table", ("pickupable",), "The ingredient lies on a table."),
    Predicate("is_cut", ("cuttable",), "The ingredient has been cut into pieces."),
    Predicate("is_cooked", ("cookable",), "The ingredient has been cooked."),
)


class Kitchen:
    """The simulator, for making pictures; the model under test never sees it."""

    def __init__(self) -> None:
        self.environment = BurgerEnvironment()
        self.environment.reset(seed=3)
        self.domain = self.environment.domain
        self.states: Sequence[Any] = self.environment.reachable_states()
        self._shuffled = random.Random(0).sample(list(self.states), len(self.states))
        self._looks: dict[Any, Observation] = {}

    def sample(self, count: int) -> list[Any]:
        """Always the same states, so that their pictures are drawn and read once."""
        return self._shuffled[:count]

    def look(self, state: Any) -> Observation:
        if state not in self._looks:
            self._looks[state] = self.environment.set_state(state)
        return self._looks[state]

    def graph(self, state: Any) -> SceneGraph:
        return read_once(self.look(state).pictures[0].png)

    def true_atoms(self, state: Any) -> set[Atom]:
        return {Atom(name, tuple(terms)) for name, terms in self.environment.true_atoms(state)}

    def transition(self, state: Any, instance: SkillInstance) -> Transition:
        success, following = self.environment.successor(state, instance)
        return Transition(self.look(state), instance, success, self.look(following))

    def find(self, skill: str, *, success: bool, seed: int) -> Transition:
        """Some transition of a skill that succeeds or fails."""
        chance = random.Random(seed)
        instances = [i for i in self.domain.skill_instances if i.skill == skill]
        while True:
            state, instance = chance.choice(self._shuffled[:200]), chance.choice(instances)
            if self.environment.successor(state, instance)[0] is success:
                return self.transition(state, instance)


read_once = lru_cache(maxsize=None)(read_burger_scene)
"""The scene reader, for all models of the tests together."""


def sketch_graph(state: BurgerState) -> SceneGraph:
    """What is to be seen in a state, without drawing it; everything in one place."""
    kinds = {"robot": "robot", "stove": "station", "board": "station", "a_table": "table"}
    kinds |= dict.fromkeys(ITEMS, "item")
    places = dict(zip(ITEMS, state.places, strict=True))
    return SceneGraph(
        tuple(Thing(n, kind, Box(0, 0, 9, 9), kind == "table") for n, kind in kinds.items()),
        {
            "held": {(item, "robot") for item, place in places.items() if place == HAND},
            "on": {
                (item, "a_table" if place == TABLE else place)
                for item, place in places.items()
                if place != HAND
            },
        },
        {"lettuce": {"cut": state.cut}, "patty": {"cooked": state.cooked}},
    )


WORDS = tuple(words for words in (find_domain("burger").words,) if words)
LEXICON = Lexicon(WORDS)
"""What the embedded model can say of the kitchen."""


def embedded_model(seed: int = 0, noise: NoiseProfile | None = None) -> EmbeddedModel:
    return EmbeddedModel(seed, noise or noise_profile("none"), (read_once,), WORDS)


@cache
def kitchen() -> Kitchen:
    return Kitchen()

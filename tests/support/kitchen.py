"""The burger kitchen with a perfect eye: concepts are read off the true state, not off pictures.

Everything else is the real thing: predicates are proposed from a pool of good and irrelevant
concepts, labels are asked for when needed, and what is learned is compared with the simulator on
every reachable state.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import HAND, ITEMS, TABLE, BurgerState
from skillwrapper.domains.burger.system_predicates import ROBOT
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import AbstractModel, Atom, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world import (
    Domain,
    Episode,
    Observation,
    Picture,
    SkillInstance,
    Transition,
)

ENVIRONMENT = BurgerEnvironment()
DOMAIN: Domain = ENVIRONMENT.domain
STATES: tuple[BurgerState, ...] = ENVIRONMENT.reachable_states()
NUMBER = {state: number for number, state in enumerate(STATES)}
FURNITURE = {"stove": (100, 100), "board": (400, 100), ROBOT: (250, 250)} | {
    f"{TABLE} {item}": (100 + 150 * number, 400) for number, item in enumerate(ITEMS)
}


def position(state: BurgerState, thing: str) -> tuple[int, int]:
    """Where a thing is drawn; each item of a stack a little above the one below."""
    if thing not in ITEMS:
        return FURNITURE[thing]
    place = state.place_of(thing)
    if place in ITEMS:
        x, y = position(state, place)
        return x, y - 20
    return FURNITURE[{HAND: ROBOT, TABLE: f"{TABLE} {thing}"}.get(place, place)]


def nearby(state: BurgerState, one: str, other: str) -> bool:
    (x, y), (u, v) = position(state, one), position(state, other)
    return abs(x - u) + abs(y - v) < 200


@dataclass(frozen=True)
class Concept:
    """A predicate that can be read off a state.

    Attributes:
        predicate: name and types.
        holds: from a state and objects to whether it is true.
        weight: how readily it is thought of.
    """

    predicate: Predicate
    holds: Callable[..., bool]
    weight: float


def _concept(name: str, types: str, holds: Callable[..., bool], weight: float = 3.0) -> Concept:
    return Concept(Predicate(name, tuple(types.split())), holds, weight)


def _place_is(*places: str) -> Callable[[BurgerState, str], bool]:
    return lambda s, item: s.place_of(item) in places


_GOOD = (
    _concept("hand_empty", "robot", lambda s, _: s.held is None),
    _concept("hand_full", "robot", lambda s, _: s.held is not None),
    _concept("free_gripper", "", lambda s: s.held is None),
    _concept("holding", "robot pickupable", lambda s, _, item: s.held == item),
    _concept("on_station", "pickupable station", lambda s, item, place: s.place_of(item) == place),
    _concept("stacked_on", "pickupable pickupable", lambda s, one, two: s.place_of(one) == two),
    _concept("station_empty", "station", lambda s, place: s.item_on(place) is None),
    _concept("occupied", "station", lambda s, place: s.item_on(place) is not None),
    _concept("nothing_on", "pickupable", lambda s, item: s.item_on(item) is None),
    _concept("covered", "pickupable", lambda s, item: s.item_on(item) is not None),
    _concept("on_table", "pickupable", _place_is(TABLE)),
    _concept("on_stove", "pickupable", _place_is("stove")),
    _concept("on_board", "pickupable", _place_is("board")),
    _concept(
        "in_stack",
        "pickupable",
        lambda s, item: s.place_of(item) in ITEMS or s.item_on(item) is not None,
    ),
    _concept("is_cut", "cuttable", lambda s, _: s.cut),
    _concept("whole", "cuttable", lambda s, _: not s.cut),
    _concept("is_cooked", "cookable", lambda s, _: s.cooked),
    _concept("raw", "cookable", lambda s, _: not s.cooked),
)


def _irrelevant() -> Iterator[Concept]:
    for pair in ("pickupable pickupable", "pickupable station", "robot pickupable"):
        ending = pair.replace(" ", "_")
        relations: dict[str, Callable[..., bool]] = {
            "left_of": lambda s, a, b: position(s, a)[0] < position(s, b)[0],
            "above": lambda s, a, b: position(s, a)[1] < position(s, b)[1],
            "near": nearby,
        }
        for name, holds in relations.items():
            yield _concept(f"{name}_{ending}", pair, holds, weight=1.0)
    yield _concept("left_half", "pickupable", lambda s, a: position(s, a)[0] < 256, weight=1.0)
    yield _concept("upper_half", "pickupable", lambda s, a: position(s, a)[1] < 256, weight=1.0)


POOL = (*_GOOD, *_irrelevant())
CONCEPTS = {concept.predicate: concept for concept in POOL}


def observe(state: BurgerState) -> Observation:
    return Observation((Picture(b"%d" % NUMBER[state]),))


def state_of(observation: Observation) -> BurgerState:
    return STATES[int(observation.pictures[0].png)]


class Eye:
    """Labels by concepts (``TruthSource``)."""

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing to do: all labels are there."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        states = [state_of(o) for o in observations]
        return label_states(space, states)


def label_states(space: AtomSpace, states: Sequence[BurgerState]) -> Labels:
    """Labels (states, atoms) of ground atoms."""
    rows = [[v for p in space.predicates for v in _read(p, space.objects, s)] for s in states]
    return np.array(rows, dtype=np.int8).reshape(len(states), len(space.atoms))


@cache
def _read(predicate: Predicate, objects: tuple[object, ...], state: BurgerState) -> list[int]:
    """A concept said of wider types holds of nothing else."""
    concept = CONCEPTS.get(predicate) or next(
        c for p, c in CONCEPTS.items() if p.name == predicate.name
    )
    known = set(concept.predicate.groundings(objects))  # type: ignore[arg-type]
    return [
        int(Atom(concept.predicate.name, a.terms) in known and concept.holds(state, *a.terms))
        for a in predicate.groundings(objects)  # type: ignore[arg-type]
    ]


class Thinker:
    """Proposes concepts of the pool that tell two transitions apart (``Proposer``)."""

    def __init__(self, recorded: RecordedTransitions, seed: int, count: int = 3) -> None:
        self._recorded = recorded
        self._chance = random.Random(seed)
        self._count = count

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> list[Predicate]:
        known = {*current, *rejected}
        left = [c for c in POOL if c.predicate not in known and self._tells(c, inconsistency)]
        chosen: list[Predicate] = []
        while left and len(chosen) < self._count:
            (one,) = self._chance.choices(left, [c.weight for c in left])
            left.remove(one)
            chosen.append(one.predicate)
        return chosen

    def _tells(self, concept: Concept, inconsistency: Inconsistency) -> bool:
        first = self._recorded.records[inconsistency.first].transition
        if inconsistency.second is None:
            objects = {t for a in inconsistency.unexplained for t in a.terms}
            return concept.predicate.arity == 2 and any(
                _changed(concept, first, pair)
                for argument in first.instance.arguments
                for other in objects - {argument}
                for pair in ((argument, other), (other, argument))
                if _fits(concept, pair)
            )
        second = self._recorded.records[inconsistency.second].transition
        effect = inconsistency.kind is InconsistencyKind.EFFECT
        return _view(concept, first, effect=effect) != _view(concept, second, effect=effect)


def _fits(concept: Concept, names: Sequence[str]) -> bool:
    types = concept.predicate.types
    return all(t in DOMAIN.object_by_name[n].types for t, n in zip(types, names, strict=True))


def _changed(concept: Concept, transition: Transition, names: Sequence[str]) -> bool:
    before, after = state_of(transition.before), state_of(transition.after)
    return concept.holds(before, *names) != concept.holds(after, *names)


def _view(concept: Concept, transition: Transition, *, effect: bool) -> list[tuple[object, ...]]:
    """What a concept says of the arguments: before, or of the change."""
    seen: list[tuple[object, ...]] = []
    arguments = transition.instance.arguments
    for places in itertools.permutations(range(len(arguments)), concept.predicate.arity):
        names = [arguments[p] for p in places]
        if _fits(concept, names):
            before = concept.holds(state_of(transition.before), *names)
            if not effect or _changed(concept, transition, names):
                seen.append((places, before))
    return seen


def explore(length: int, seed: int) -> Episode:
    """A random walk in which half of the skills are chosen among those that work now.

    Often the next skill is about the same things, else hardly anything is ever cut or cooked.
    """
    chance = random.Random(seed)
    state = STATES[0]
    transitions: list[Transition] = []
    for _ in range(length):
        instance = _next(state, transitions, chance)
        success, following = ENVIRONMENT.successor(state, instance)
        transitions.append(Transition(observe(state), instance, success, observe(following)))
        state = following
    return Episode(DOMAIN.scene(), 0, tuple(transitions))


def _next(state: BurgerState, done: Sequence[Transition], chance: random.Random) -> SkillInstance:
    pool = list(DOMAIN.skill_instances)
    if chance.random() < 0.5:
        pool = [i for i in pool if ENVIRONMENT.successor(state, i)[0]] or pool
    if done and chance.random() < 0.6:
        thing = chance.choice(done[-1].instance.arguments[1:])
        pool = [i for i in pool if thing in i.arguments] or pool
    return chance.choice(pool)


@dataclass(frozen=True)
class Score:
    """How a model compares with the simulator over all states and skill instances, 0 to 1."""

    precision: float
    recall: float
    effects: float
    recall_by_skill: dict[str, float]


@cache
def _truth(instance: SkillInstance) -> tuple[np.ndarray, np.ndarray]:
    """For every state, whether the instance succeeds, and the number of the next state."""
    outcomes = [ENVIRONMENT.successor(state, instance) for state in STATES]
    return np.array([o[0] for o in outcomes]), np.array([NUMBER[o[1]] for o in outcomes])


def compare(model: AbstractModel) -> Score:
    """A model against the simulator: every state, every instance, every applicable operator."""
    ground = GroundModel.of(model, DOMAIN.objects)
    states = label_states(ground.space, STATES)
    counts: dict[str, np.ndarray] = {s.name: np.zeros(5, dtype=int) for s in DOMAIN.skills}
    for instance in DOMAIN.skill_instances:
        success, following = _truth(instance)
        predicted = np.zeros(len(STATES), dtype=bool)
        right = made = 0
        for bindings in ground.bind(states, [instance]):
            rows = bindings.sure.rows
            predicted[rows] = True
            agrees = (bindings.sure.successors() == states[following[rows]]).all(1)
            made += int(success[rows].sum())
            right += int(agrees[success[rows]].sum())
        found = [(predicted & success).sum(), predicted.sum(), success.sum(), right, made]
        counts[instance.skill] += np.array(found)
    total = sum(counts.values())
    return Score(
        precision=total[0] / total[1],
        recall=total[0] / total[2],
        effects=total[3] / total[4],
        recall_by_skill={name: c[0] / c[2] for name, c in counts.items()},
    )

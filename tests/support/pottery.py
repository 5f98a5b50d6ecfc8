"""A pottery to explore: skills that may change nothing, firing that cannot be undone, and pictures
that are no function of the state, because the potter may stand anywhere.

The vocabulary is known and read without error, so that what is learned is the explorer's doing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import count

import numpy as np
from notebook import atom, make_domain

from skillwrapper.exploration.explorer import Explorer, Situation
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import AbstractModel, Atom, Operator, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world import Episode, Observation, Picture, SkillInstance, Transition

LUMPS, PLACES = ("red", "grey"), ("shelf", "wheel", "kiln")
POTTERY = make_domain(
    types={"potter": (), "lump": (), "place": (), "board": ("place",), "machine": ("place",)}
    | {"turning": ("machine",), "burning": ("machine",)},
    objects={"p": "potter", "red": "lump", "grey": "lump"}
    | {"shelf": "board", "wheel": "turning", "kiln": "burning"},
    skills={
        "Take": "potter lump",
        "Put": "potter lump place",
        "Wet": "potter lump",
        "Shape": "potter lump",
        "Fire": "potter lump",
    },
)
WORDS = (
    Predicate("free", ("potter",)),
    Predicate("holds", ("potter", "lump")),
    Predicate("at", ("lump", "place")),
    Predicate("taken", ("machine",)),
    Predicate("wet", ("lump",)),
    Predicate("shaped", ("lump",)),
    Predicate("fired", ("lump",)),
)
SPACE = AtomSpace(WORDS, POTTERY.objects)


@dataclass(frozen=True)
class Lump:
    place: str = "shelf"
    wet: bool = False
    shaped: bool = False
    fired: bool = False


State = tuple[Lump, Lump]
"""The red lump and the grey one."""
START: State = (Lump(), Lump())


@cache
def true_atoms(state: State) -> frozenset[Atom]:
    return frozenset(_true_atoms(state))


def _true_atoms(state: State) -> Iterator[Atom]:
    places = [lump.place for lump in state]
    yield from [atom("free(p)")] if "hand" not in places else []
    for machine in {"wheel", "kiln"} & set(places):
        yield atom(f"taken({machine})")
    for name, lump in zip(LUMPS, state, strict=True):
        yield atom(f"holds(p, {name})" if lump.place == "hand" else f"at({name}, {lump.place})")
        for word in ("wet", "shaped", "fired"):
            yield from [atom(f"{word}({name})")] if getattr(lump, word) else []


@cache
def succeed(state: State, instance: SkillInstance) -> State | None:
    """The next state, which may be the same; None if the skill fails."""
    places = [lump.place for lump in state]
    number = LUMPS.index(instance.arguments[1])
    lump, after = state[number], None
    match instance.skill:
        case "Take" if "hand" not in places:
            after = replace(lump, place="hand")
        case "Put" if lump.place == "hand":
            place = instance.arguments[2]
            after = replace(lump, place=place) if place == "shelf" or place not in places else None
        case "Wet" if lump.place == "hand" and not lump.fired:
            after = replace(lump, wet=True)
        case "Shape" if lump.place == "wheel" and lump.wet and not lump.fired:
            after = replace(lump, shaped=True)
        case "Fire" if lump.place == "kiln" and lump.shaped and "hand" not in places:
            after = replace(lump, fired=True, wet=False)
    if after is None:
        return None
    return (after, state[1]) if number == 0 else (state[0], after)


class Eye:
    """Reads the states that pictures show, no two of which are alike."""

    def __init__(self) -> None:
        self._states: dict[str, State] = {}
        self._number = count()

    def observe(self, state: State) -> Observation:
        seen = Observation((Picture(f"{next(self._number)}".encode()),))
        self._states[seen.key] = state
        return seen

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        true = [true_atoms(self._states[o.key]) for o in observations]
        rows = [[a in own for a in space.atoms] for own in true]
        return np.array(rows, dtype=np.int8).reshape(len(observations), len(space.atoms))

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        pass


def all_states() -> tuple[State, ...]:
    found, waiting = {START}, [START]
    while waiting:
        state = waiting.pop()
        for instance in POTTERY.skill_instances:
            after = succeed(state, instance)
            if after is not None and after not in found:
                found.add(after)
                waiting.append(after)
    return tuple(sorted(found, key=repr))


STATES = all_states()


@cache
def row(state: State) -> Labels:
    true = true_atoms(state)
    labels = np.array([a in true for a in SPACE.atoms], dtype=np.int8)
    labels.flags.writeable = False
    return labels


def mistakes(model: AbstractModel) -> list[tuple[State, SkillInstance]]:
    """Where a model predicts another outcome than the true one, in all states."""
    ground = GroundModel.from_operators(model.operators, SPACE)
    labels, wrong = np.array([row(state) for state in STATES]), []
    for instance in POTTERY.skill_instances:
        predicted: list[set[bytes]] = [set() for _ in STATES]
        for bindings in ground.bind(labels, [instance]):
            sure = bindings.sure
            for number, after in zip(sure.rows, sure.successors(), strict=True):
                predicted[number].add(after.tobytes())
        for state, found in zip(STATES, predicted, strict=True):
            after = succeed(state, instance)
            if found != (set() if after is None else {row(after).tobytes()}):
                wrong.append((state, instance))
    return wrong


def explore(
    explorer: Explorer, most: int, *, length: int = 15, told: Callable[[str], object] = str
) -> int | None:
    """Executions until the model makes no mistake; None if it still makes some after the most."""
    eye, recorded = Eye(), RecordedTransitions(POTTERY)
    labeller, learner, scene = Labeller(recorded, eye), FaithfulLearner(), POTTERY.scene()
    judged: tuple[Operator, ...] = ()

    def learn() -> Fit:
        return learner.learn(labeller.label(WORDS))

    while len(recorded) < most:
        state, seen, done = START, eye.observe(START), []
        while len(done) < length and len(recorded) < most:
            here = seen
            situation = Situation(
                scene, here, tuple(done), length - len(done), learn,
                lambda space, here=here: eye.labels(space, [here])[0],
            )  # fmt: skip
            chosen = explorer.next_skill(situation)
            if chosen.instance is None:
                break
            after = succeed(state, chosen.instance)
            state = state if after is None else after
            seen = eye.observe(state)
            done.append(Transition(here, chosen.instance, after is not None, seen))
            recorded.add(Episode(scene, 0, (done[-1],)))
            told(f"{len(recorded)} {chosen.instance} {after is not None} {chosen.reason}")
            model = learn().model
            if model.operators != judged:
                judged = model.operators
                if not mistakes(model):
                    return len(recorded)
        explorer.record(Episode(scene, 0, tuple(done)))
    return None

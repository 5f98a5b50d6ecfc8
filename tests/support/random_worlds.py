"""Random transitions of a small domain whose types form no tree, drawn from a seed."""

from __future__ import annotations

import random

from hypothesis import settings
from hypothesis import strategies as st
from notebook import Notebook, make_domain

from skillwrapper.symbols import Atom, Predicate, all_groundings

QUICK = settings(max_examples=100, deadline=None, derandomize=True)

DOMAIN = make_domain(
    types={"robot": (), "thing": (), "food": ("thing",), "hot": ("thing",)},
    objects={"r": "robot", "a": "food", "b": "food hot", "c": "hot", "d": "thing"},
    skills={"Use": "robot thing", "Join": "thing thing", "Wait": ""},
)
PREDICATES = (
    Predicate("dark", ()),
    Predicate("clean", ("thing",)),
    Predicate("ready", ("hot",)),
    Predicate("on", ("thing", "thing")),
    Predicate("holds", ("robot", "thing")),
)
ATOMS = all_groundings(PREDICATES, DOMAIN.objects)
SCENES = (("r", "a", "b", "c", "d"), ("r", "a", "c"))


def _write(true: set[Atom], unknown: set[Atom]) -> str:
    return " ".join([*map(str, sorted(true - unknown)), *(f"?{a}" for a in sorted(unknown))])


def _some(chance: random.Random, least: int, most: int) -> set[Atom]:
    return set(chance.sample(ATOMS, chance.randint(least, most)))


def random_notebook(seed: int, *, unknowns: bool = False) -> Notebook:
    """A few transitions between few states and of few instances, so that much is in common.

    Full states with many atoms show what always held; changes are drawn from a small pool, so
    that several successes share one.
    """
    chance = random.Random(seed)
    notebook = Notebook(DOMAIN, *PREDICATES)
    skill = chance.choice(DOMAIN.skills).name
    instances = [i for i in DOMAIN.skill_instances if i.skill == skill]
    instances = chance.sample(instances, min(len(instances), chance.randint(1, 3)))
    states = [_some(chance, 0, 16) for _ in range(chance.randint(1, 4))]
    changes = [_some(chance, 0, 3) for _ in range(chance.randint(1, 2))]
    for _ in range(chance.randint(2, 12)):
        done = chance.choice(instances)
        success = chance.random() < 0.6
        before = chance.choice(states)
        after = before ^ chance.choice(changes) if success or chance.random() < 0.2 else before
        unsure = [_some(chance, 0, 2) if unknowns else set() for _ in range(2)]
        scene = chance.choice([s for s in SCENES if set(done.arguments) <= set(s)])
        step = _write(before, unsure[0]), str(done), success, _write(after, unsure[1])
        notebook.episode(step, scene=scene)
    return notebook


def notebooks(*, unknowns: bool = False) -> st.SearchStrategy[Notebook]:
    return st.integers(0, 10**9).map(lambda seed: random_notebook(seed, unknowns=unknowns))

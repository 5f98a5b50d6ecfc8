"""Random transitions of a small domain whose types form no tree, drawn from a seed."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

from hypothesis import settings
from hypothesis import strategies as st
from notebook import Notebook, make_domain

from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.world import SkillInstance

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


@dataclass(frozen=True)
class Step:
    """A transition: the objects there, what was run, and the atoms before and after."""

    scene: tuple[str, ...]
    instance: SkillInstance
    success: bool
    true: tuple[set[Atom], set[Atom]]
    unknown: tuple[set[Atom], set[Atom]]

    def entry(self) -> dict[str, Any]:
        """As plain data, for ``label_entries``."""
        objects = [o for o in DOMAIN.objects if o.name in self.scene]
        atoms = all_groundings(PREDICATES, objects)
        before, after = (
            {str(a): None if a in unknown else a in true for a in atoms}
            for true, unknown in zip(self.true, self.unknown, strict=True)
        )
        return {
            "skill": self.instance.skill,
            "arguments": list(self.instance.arguments),
            "success": self.success,
            "objects": list(self.scene),
            "before": before,
            "after": after,
        }


def random_steps(seed: int, *, skills: int = 1, unknowns: bool = False) -> list[Step]:
    """A few transitions between few states and of few instances, so that much is in common.

    Full states with many atoms show what always held; changes are drawn from a small pool, so
    that several successes share one.
    """
    chance = random.Random(seed)
    names = {skill.name for skill in chance.sample(DOMAIN.skills, skills)}
    instances = [i for i in DOMAIN.skill_instances if i.skill in names]
    instances = chance.sample(instances, min(len(instances), chance.randint(1, 3 * skills)))
    states = [_some(chance, 0, 16) for _ in range(chance.randint(1, 4))]
    changes = [_some(chance, 0, 3) for _ in range(chance.randint(1, 2))]
    steps = []
    for _ in range(chance.randint(2, 12)):
        done = chance.choice(instances)
        success = chance.random() < 0.6
        before = chance.choice(states)
        after = before ^ chance.choice(changes) if success or chance.random() < 0.2 else before
        unsure = [_some(chance, 0, 2) if unknowns else set() for _ in range(2)]
        scene = chance.choice([s for s in SCENES if set(done.arguments) <= set(s)])
        steps.append(Step(scene, done, success, (before, after), (unsure[0], unsure[1])))
    return steps


def random_notebook(seed: int, *, unknowns: bool = False) -> Notebook:
    """Random steps of one skill, as pictures."""
    notebook = Notebook(DOMAIN, *PREDICATES)
    for step in random_steps(seed, unknowns=unknowns):
        before, after = map(_write, step.true, step.unknown)
        notebook.episode((before, str(step.instance), step.success, after), scene=step.scene)
    return notebook


def notebooks(*, unknowns: bool = False) -> st.SearchStrategy[Notebook]:
    return st.integers(0, 10**9).map(lambda seed: random_notebook(seed, unknowns=unknowns))

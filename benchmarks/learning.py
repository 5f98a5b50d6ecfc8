"""Operator learning on many burger transitions: seconds, and whether they grow linearly.

The labels are those of a perfect vocabulary of nine predicates (34 ground atoms), so that the
figure is that of the learner alone.
"""

from __future__ import annotations

import time

import numpy as np

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.system_predicates import SYSTEM_PREDICATES
from skillwrapper.grounding import AtomSpace
from skillwrapper.learning.clusters import cluster_successes
from skillwrapper.learning.determinism import fit_skill
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.operators import cluster_operators
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.tables import SkillTable

SIZES = (12_500, 25_000, 50_000, 100_000)
NOTHING_ON = Predicate("nothing_on", ("pickupable",), "Nothing lies on the ingredient.")
HAND_FULL = Predicate("hand_full", ("robot",), "The robot holds something.")


class Kitchen:
    """All state-instance pairs of the burger kitchen with their labels."""

    def __init__(self) -> None:
        environment = BurgerEnvironment()
        self.domain = environment.domain
        predicates = tuple(p for p in SYSTEM_PREDICATES if p.name != "on_table")
        self.space = AtomSpace((*predicates, NOTHING_ON, HAND_FULL), self.domain.objects)
        states = environment.reachable_states()
        row = {state: number for number, state in enumerate(states)}
        self.labels = np.array(
            [self._labels(set(environment.true_atoms(s))) for s in states], dtype=np.int8
        )
        outcomes = [
            [environment.successor(s, i) for i in self.domain.skill_instances] for s in states
        ]
        self.success = np.array([[done for done, _ in line] for line in outcomes])
        self.following = np.array([[row[after] for _, after in line] for line in outcomes])

    def _labels(self, true: set[tuple[str, tuple[str, ...]]]) -> list[bool]:
        covered = {terms[1] for name, terms in true if name == "stacked_on"}
        held = any(name == "holding" for name, _ in true)
        derived = {
            NOTHING_ON.name: lambda a: a.terms[0] not in covered,
            HAND_FULL.name: lambda _: held,
        }
        return [
            derived[atom.predicate](atom)
            if atom.predicate in derived
            else (atom.predicate, atom.terms) in true
            for atom in self.space.atoms
        ]

    def draw(self, size: int, seed: int) -> dict[str, tuple[SkillTable, ...]]:
        """Transitions drawn at random, half of them successful, by skill."""
        chance = np.random.default_rng(seed)
        good = np.argwhere(self.success)
        bad = np.argwhere(~self.success)
        pairs = np.vstack(
            [
                good[chance.integers(len(good), size=size // 2)],
                bad[chance.integers(len(bad), size=size - size // 2)],
            ]
        )
        instances = self.domain.skill_instances
        names = np.array([i.skill for i in instances])[pairs[:, 1]]
        return {
            skill.name: (self._table(pairs[names == skill.name]),) for skill in self.domain.skills
        }

    def _table(self, pairs: np.ndarray) -> SkillTable:  # type: ignore[type-arg]
        state, instance = pairs[:, 0], pairs[:, 1]
        occurring, which = np.unique(instance, return_inverse=True)
        return SkillTable(
            space=self.space,
            instances=tuple(self.domain.skill_instances[i] for i in occurring),
            which=which,
            success=self.success[state, instance],
            before=self.labels[state],
            after=self.labels[self.following[state, instance]],
            ids=np.arange(len(pairs)),
            unchanged=np.zeros(len(pairs), dtype=bool),
        )


def main() -> None:
    """Print seconds for several sizes and their ratio to the smallest."""
    kitchen = Kitchen()
    print(f"operator learning, {len(kitchen.space.atoms)} ground atoms, one core")
    settings = LearnerSettings()
    languages = [
        OperatorLanguage(kitchen.domain, skill, kitchen.space.predicates, settings)
        for skill in kitchen.domain.skills
    ]
    first = 0.0
    for size in SIZES:
        data = kitchen.draw(size, seed=0)
        started = time.perf_counter()
        for language in languages:
            cluster_operators(language, cluster_successes(data[language.skill.name]))
        seconds = time.perf_counter() - started
        fits = [fit_skill(language, data[language.skill.name]) for language in languages]
        complete = time.perf_counter() - started - seconds
        wrong = sum(len(fit.inconsistencies) for fit in fits)
        first = first or seconds
        growth = (seconds / first) / (size / SIZES[0])
        print(
            f"{size:7d} transitions  operators {seconds:5.2f} s  all checks {complete:5.2f} s  "
            f"{wrong} inconsistencies  time a transition, first row = 1: {growth:.2f}"
        )


if __name__ == "__main__":
    main()

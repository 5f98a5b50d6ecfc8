"""What held-back episodes say of a model's error, beside its error on all that can happen."""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from functools import cache

import numpy as np
import pytest
from sketched_kitchen import SketchedKitchen, space

from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.theory.held_back import HeldBackError, Labelling, hold_back
from skillwrapper.grounding import TRUE, AtomSpace, Labels
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.learning.learner import make_learner
from skillwrapper.learning.predictions import predict
from skillwrapper.runs.settings import SharedSettings
from skillwrapper.world import Observation, Transition
from skillwrapper.world.episode import Episode

KITCHEN = SketchedKitchen()
WORDS = expert_model().predicates


class Reader:
    """Reads what is written down of a state; some atoms of some pictures wrongly.

    Args:
        misread: how often.
    """

    def __init__(self, misread: float = 0.0) -> None:
        self._misread = misread

    def prefetch(self, wanted: Iterable[object]) -> None:
        pass

    def labels(self, atoms: AtomSpace, observations: Sequence[Observation]) -> Labels:
        labels = np.zeros((len(observations), len(atoms.atoms)), dtype=np.int8)
        for row, observation in enumerate(observations):
            text = observation.pictures[0].png.decode()
            for atom in expert_atoms(eval(text, {"BurgerState": BurgerState})):
                labels[row, atoms.column[atom]] = TRUE
            chance = random.Random(text)
            wrong = [chance.random() < self._misread for _ in atoms.atoms]
            labels[row] ^= np.array(wrong, dtype=np.int8)
        return labels


def seen(state: BurgerState) -> Observation:
    return Observation((KITCHEN.draw(state, 0),))


def walk(chance: random.Random, steps: int) -> Episode:
    """Steps from wherever, half of them some that succeed."""
    states = space()
    at, done = chance.randrange(len(states.states)), []
    for _ in range(steps):
        working = np.flatnonzero(states.success[at]).tolist()
        pool = working if chance.random() < 0.5 and working else range(len(states.instances))
        number = chance.choice(list(pool))
        after = int(states.following[at, number])
        success = bool(states.success[at, number])
        before, instance = seen(states.states[at]), states.instances[number]
        done.append(Transition(before, instance, success, seen(states.states[after])))
        at = after
    return Episode(KITCHEN.scene, 0, tuple(done))


@cache
def walks() -> tuple[Episode, ...]:
    chance = random.Random(5)
    return tuple(walk(chance, 14) for _ in range(4))


def labelling(learner: str, misread: float = 0.0) -> Labelling:
    settings = SharedSettings(learning=LearningSettings(learner=learner))
    return Labelling(KITCHEN.domain, Reader(misread), WORDS, settings)


def true_error(learned_by: Labelling) -> float:
    """Of the model of all episodes, on as many other walks as make chance small."""
    settings = learned_by.settings
    decodes = settings.decodes_labels
    fit = make_learner(settings.learning).learn(learned_by.label(walks(), decodes=decodes))
    chance = random.Random(77)
    exact = labelling("faithful").label([walk(chance, 12) for _ in range(25)], decodes=False)
    wrong = tried = 0
    for skill in exact.domain.skills:
        for found in predict(exact.of_skill(skill.name), fit.skill(skill.name).operators):
            wrong, tried = wrong + int(found.wrong.sum()), tried + len(found.table)
    return wrong / tried


def test_the_interval_holds_the_true_error() -> None:
    by = labelling("faithful")
    found = hold_back(walks(), by)
    low, high = found.interval
    assert found.at_most == high
    assert found.wrong > 0
    assert low <= true_error(by) <= high


def test_where_labels_are_misread_the_true_error_is_no_greater_than_said() -> None:
    by = labelling("robust", misread=0.02)
    found = hold_back(walks(), by)
    assert true_error(by) <= found.at_most < 1
    assert found.wrong_as_read is not None
    assert found.wrong_as_read > found.wrong


def test_misreadings_widen_what_is_possible() -> None:
    assert HeldBackError(1, 10, 0, 0.95, (0.1, 0.2)).at_most == 0.2
    both = HeldBackError(1, 100, 0, 0.95, (0.0, 0.05), 30, 100)
    assert both.at_most == pytest.approx(0.4, abs=0.03)

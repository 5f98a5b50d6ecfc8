"""The example world, read with errors: nothing about decoding is made for one domain."""

from __future__ import annotations

import random
import zlib
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import pytest

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.eyesight import Eyesight
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.robust import RobustLearner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.perception.overruling import check_overruling
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world import Episode, Observation, Transition, ground_skills

PACKAGE = find_domain(str(Path(__file__).parents[2] / "examples" / "greenhouse"))
VOCABULARY = (
    Predicate("soil_moist", ("pot",), "the soil of the pot is wet."),
    Predicate("has_shoots", ("pot",), "long shoots grow out of the plant in the pot."),
    Predicate("placed_over", ("bell", "pot"), "the bell covers the pot."),
)
EXACT = ExactReader(Eyesight.for_packages([PACKAGE]))


class _Blurred:
    """Reads with errors, the same ones whenever the same picture is read."""

    def __init__(self, seed: int, rate: float) -> None:
        self._seed, self._rate = seed, rate

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing to do: looking costs nothing."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        true = EXACT.labels(space, observations)
        errs = [
            [zlib.crc32(f"{self._seed} {o.key} {a}".encode()) < self._rate * 2**32
             for a in space.atoms]
            for o in observations
        ]  # fmt: skip
        return np.where(np.array(errs), 1 - true, true).astype(np.int8)


def _recorded(seed: int) -> RecordedTransitions:
    """Twelve episodes of fifteen skills, chosen at random, in both scenes."""
    environment, chance = PACKAGE.make_environment(), random.Random(seed)
    recorded = RecordedTransitions(PACKAGE.domain)
    for number in range(12):
        scene = list(PACKAGE.domain.scenes)[number % 2]
        seen, done = environment.reset(seed=100 * seed + number, scene=scene), []
        possible = ground_skills(PACKAGE.domain.skills, environment.scene.objects)
        for _ in range(15):
            instance = chance.choice(possible)
            outcome = environment.execute(instance)
            done.append(
                Transition(seen, instance, outcome.success, outcome.observation, outcome.changed)
            )
            seen = outcome.observation
        recorded.add(Episode(environment.scene, number, tuple(done)))
    return recorded


def _described(fit: Fit) -> list[str]:
    return [str(learned.operator) for learned in fit.operators]


@pytest.mark.parametrize("rate", [0.0, 0.03])
@pytest.mark.parametrize("seed", range(3))
def test_the_robust_learner_learns_what_the_truth_teaches(seed: int, rate: float) -> None:
    recorded = _recorded(seed)
    labeller = DecodedLabeller(recorded, _Blurred(seed, rate), lambda: VOCABULARY)
    robust = RobustLearner().learn(labeller.label(VOCABULARY))
    truth = FaithfulLearner().learn(Labeller(recorded, EXACT).label(VOCABULARY))
    check = check_overruling(labeller, EXACT)
    assert check.right >= 0.9 * check.overruled
    assert check.right >= 0.9 * check.misread
    if rate == 0:
        assert _described(robust) == _described(truth)
    assert len(robust.operators) <= len(truth.operators) + 1

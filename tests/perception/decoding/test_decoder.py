"""Decoding: errors are overruled, the truth is not, whatever else is known."""

from __future__ import annotations

import numpy as np
import pytest
from kitchen import compare
from misread_kitchen import VOCABULARY, MisreadKitchen, space_of

from skillwrapper.grounding import UNKNOWN, AtomSpace, Labels
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.decoding.chains import Chain, chains_of
from skillwrapper.perception.decoding.decoder import Decoding, decode
from skillwrapper.symbols import Predicate
from skillwrapper.world import Observation


def _seen(kitchen: MisreadKitchen) -> tuple[Observation, ...]:
    (scene,) = kitchen.recorded.scenes
    return kitchen.recorded.observations(scene)


def _decoded(kitchen: MisreadKitchen, labels: Labels | None = None) -> Decoding:
    read = kitchen.labels(space_of(), _seen(kitchen)) if labels is None else labels
    return decode(chains_of(kitchen.recorded), VOCABULARY, [read])


@pytest.mark.parametrize("seed", range(2))
def test_what_is_read_rightly_stays_as_it_is(seed: int) -> None:
    kitchen = MisreadKitchen(150, seed)
    believed = _decoded(kitchen).beliefs(0)
    truth = kitchen.truth(space_of(), _seen(kitchen))
    assert ((believed > 0.5) == (truth == 1)).all()
    assert (np.abs(believed - 0.5) > 0.4).mean() > 0.99


@pytest.mark.parametrize("seed", range(2))
def test_misreadings_are_overruled(seed: int) -> None:
    kitchen = MisreadKitchen(300, seed, rate=0.03)
    truth = kitchen.truth(space_of(), _seen(kitchen))
    read = kitchen.labels(space_of(), _seen(kitchen))
    wrong = (_decoded(kitchen).beliefs(0) > 0.5) != (truth == 1)
    assert (read != truth).sum() > 100
    assert wrong.sum() < 0.1 * (read != truth).sum()


def test_what_was_not_read_is_filled_in_or_left_in_doubt() -> None:
    kitchen = MisreadKitchen(300, seed=1)
    truth = kitchen.truth(space_of(), _seen(kitchen))
    read = truth.copy()
    read[np.random.default_rng(0).random(read.shape) < 0.1] = UNKNOWN
    believed = _decoded(kitchen, read).beliefs(0)
    sure = np.abs(believed - 0.5) > 0.4
    assert ((believed > 0.5) == (truth == 1))[sure].mean() > 0.999
    assert sure[read == UNKNOWN].mean() > 0.9


def test_error_rates_are_estimated_without_the_truth() -> None:
    kitchen = MisreadKitchen(300, seed=2, rate=0.05)
    rates = _decoded(kitchen).rates
    holding = next(p for p in VOCABULARY if p.name == "holding")
    assert 0.03 < rates[holding].false_positive < 0.07


def test_candidates_are_decoded_given_the_vocabulary() -> None:
    kitchen = MisreadKitchen(300, seed=3, rate=0.03)
    *rest, last = VOCABULARY
    chains, seen = chains_of(kitchen.recorded), _seen(kitchen)
    known = decode(chains, rest, [kitchen.labels(space_of(rest), seen)])
    own = space_of([last])
    found = decode(chains, [last], [kitchen.labels(own, seen)], given=known)
    truth = kitchen.truth(own, seen)
    assert ((found.beliefs(0) > 0.5) != (truth == 1)).sum() <= 1
    assert known.without({rest[0].name}).predicates == tuple(rest[1:])


@pytest.mark.parametrize("seed", range(2))
def test_the_faithful_learner_gets_far_on_decoded_labels(seed: int) -> None:
    kitchen = MisreadKitchen(450, seed, rate=0.03)
    labeller = DecodedLabeller(kitchen.recorded, kitchen, lambda: VOCABULARY)
    fit = FaithfulLearner().learn(labeller.label(VOCABULARY))
    score = compare(fit.model)
    assert (score.precision, score.effects) == pytest.approx((1, 1), abs=0.05)
    assert len(fit.operators) <= 10


def test_nothing_depends_on_what_was_decoded_before() -> None:
    kitchen, later = MisreadKitchen(60, seed=4, rate=0.05), MisreadKitchen(60, seed=4, rate=0.05)
    used: list[Predicate] = list(VOCABULARY[:3])
    labeller = DecodedLabeller(kitchen.recorded, kitchen, lambda: used)
    (scene,) = kitchen.recorded.scenes
    labeller.values(scene, VOCABULARY)
    used[:] = VOCABULARY
    fresh = DecodedLabeller(later.recorded, later, lambda: VOCABULARY)
    assert np.array_equal(labeller.values(scene, VOCABULARY), fresh.values(scene, VOCABULARY))


def test_an_observation_is_read_as_it_was_decoded() -> None:
    kitchen = MisreadKitchen(150, seed=5, rate=0.05)
    labeller = DecodedLabeller(kitchen.recorded, kitchen, lambda: VOCABULARY)
    (scene,) = kitchen.recorded.scenes
    space = AtomSpace(VOCABULARY, scene.objects)
    seen = _seen(kitchen)
    rows = [labeller.read(scene, o, space) for o in seen]
    assert np.array_equal(np.array(rows), labeller.values(scene, VOCABULARY))
    assert not np.array_equal(np.array(rows), labeller.readings(scene, VOCABULARY))


def test_no_data_and_no_vocabulary_are_no_mistake() -> None:
    kitchen = MisreadKitchen(15, seed=6)
    chains = chains_of(kitchen.recorded)
    assert decode(chains, (), [np.zeros((chains[0].nodes, 0), dtype=np.int8)]).rates == {}
    assert decode((), VOCABULARY, []).posterior == ()


def test_a_single_picture_is_read_as_it_is() -> None:
    kitchen = MisreadKitchen(15, seed=7)
    (chain,) = chains_of(kitchen.recorded)
    none = np.zeros(0, dtype=np.intp)
    alone = Chain(chain.scene, 1, (), none, none, none)
    truth = kitchen.truth(space_of(), _seen(kitchen)[:1])
    assert ((decode([alone], VOCABULARY, [truth]).beliefs(0) > 0.5) == (truth == 1)).all()

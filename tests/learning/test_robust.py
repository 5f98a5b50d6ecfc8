"""The robust learner: the same as the faithful one where nothing is in doubt."""

from __future__ import annotations

import time

import numpy as np
import pytest
from kitchen import DOMAIN
from misread_kitchen import VOCABULARY, MisreadKitchen, space_of

from skillwrapper.learning.certification import certify
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import Learner
from skillwrapper.learning.robust import RobustLearner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.transitions.labelled import LabelledTransitions, SceneTransitions


def _described(fit: Fit) -> list[str]:
    return [str(learned.operator) for learned in fit.operators]


@pytest.mark.parametrize("seed", range(5))
def test_with_perfect_labels_both_learn_the_same(seed: int) -> None:
    kitchen = MisreadKitchen(150, seed)
    decoded = DecodedLabeller(kitchen.recorded, kitchen, lambda: VOCABULARY)
    robust = RobustLearner().learn(decoded.label(VOCABULARY))
    raw = Labeller(kitchen.recorded, kitchen).label(VOCABULARY)
    assert _described(robust) == _described(FaithfulLearner().learn(raw))


def _seconds(learner: Learner, transitions: LabelledTransitions) -> float:
    started = time.process_time()
    assert learner.learn(transitions).operators
    return time.process_time() - started


def test_doubting_costs_little() -> None:
    kitchen = MisreadKitchen(450, seed=1)
    raw = Labeller(kitchen.recorded, kitchen).label(VOCABULARY)
    decoded = DecodedLabeller(kitchen.recorded, kitchen, lambda: VOCABULARY).label(VOCABULARY)
    faithful = min(_seconds(FaithfulLearner(), raw) for _ in range(3))
    assert min(_seconds(RobustLearner(), decoded) for _ in range(3)) < 1.5 * faithful + 0.05


def _with_one_wrong(confidence: float) -> LabelledTransitions:
    """After one Pick the patty is cooked, as far as one label says."""
    kitchen = MisreadKitchen(300, seed=1)
    (scene,) = kitchen.recorded.scenes
    space, executions = space_of(), kitchen.recorded.executions(scene)
    values = kitchen.truth(space, kitchen.recorded.observations(scene))
    sure = np.ones(values.shape, dtype=np.float32) - np.float32(1e-6)
    column = next(c for a, c in space.column.items() if a.predicate == "is_cooked")
    picks = [
        int(after)
        for which, done, after in zip(
            executions.which, executions.success, executions.after, strict=True
        )
        if done
        and executions.instances[which].skill == "Pick"
        and not values[after, column]
        and "patty" in executions.instances[which].arguments
    ]
    values[picks[0], column] = 1
    sure[picks[0], column] = confidence
    return LabelledTransitions(
        DOMAIN, VOCABULARY, (SceneTransitions.of(executions, space, values, sure),)
    )


def test_an_operator_that_rests_on_a_doubtful_label_is_left_out() -> None:
    transitions = _with_one_wrong(0.92)
    faithful, robust = FaithfulLearner().learn(transitions), RobustLearner().learn(transitions)
    assert len(robust.operators) < len(faithful.operators)
    assert len(robust.inconsistencies) < len(faithful.inconsistencies)
    assert any(fit.left_out for fit in robust.skills.values())


def test_the_certificate_tells_what_is_explained_and_what_is_overruled() -> None:
    robust = RobustLearner().learn(_with_one_wrong(0.92))
    found = certify(robust)
    (one,) = found.left_out
    assert (one.skill, one.transition) == ("Pick", next(iter(_left_out_ids(robust))))
    assert "is_cooked(patty)" in one.reason
    broken = {violation.transition for violation in found.violations}
    assert one.transition in broken
    assert found.explained == 1 - len(broken) / found.decided


def _left_out_ids(fit: Fit) -> frozenset[int]:
    clusters = (cluster for skill in fit.skills.values() for cluster in skill.left_out)
    return frozenset(int(number) for cluster in clusters for number in cluster.ids)


def test_what_is_not_in_doubt_is_never_explained_away() -> None:
    transitions = _with_one_wrong(1.0)
    certain = LabelledTransitions(
        DOMAIN,
        VOCABULARY,
        tuple(SceneTransitions.of(s.executions, s.space, s.values) for s in transitions.scenes),
    )
    faithful, robust = FaithfulLearner().learn(certain), RobustLearner().learn(certain)
    assert _described(robust) == _described(faithful)


def test_what_a_single_success_tells_is_worth_seeing_again() -> None:
    kitchen = MisreadKitchen(60, seed=1)
    decoded = DecodedLabeller(kitchen.recorded, kitchen, lambda: VOCABULARY)
    fit = RobustLearner().learn(decoded.label(VOCABULARY))
    alone = {o.cluster.ids[0] for o in fit.operators if len(o.cluster.ids) == 1}
    assert alone
    assert alone <= {number for of in fit.skills.values() for number in of.frail}
    raw = Labeller(kitchen.recorded, kitchen).label(VOCABULARY)
    certain = RobustLearner().learn(raw)
    assert not any(of.frail for of in certain.skills.values())

"""Learners by name, and what holds of whatever they are given."""

from __future__ import annotations

import random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_worlds import DOMAIN, PREDICATES, QUICK, random_steps

from skillwrapper.errors import UnknownNameError
from skillwrapper.learning import faithful
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import learn_operators, make_learner
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.entries import label_entries
from skillwrapper.transitions.labelled import LabelledTransitions

Entries = list[dict[str, Any]]
worlds = st.builds(
    lambda seed, unknowns: [s.entry() for s in random_steps(seed, skills=2, unknowns=unknowns)],
    st.integers(0, 10**9),
    st.booleans(),
)


def labelled(entries: Entries) -> LabelledTransitions:
    return label_entries(DOMAIN, entries, PREDICATES)


def kinds(fit: Fit) -> list[tuple[str, str]]:
    return sorted((i.skill, str(i.kind)) for i in fit.inconsistencies)


@QUICK
@given(worlds, st.integers(0, 10**9))
def test_the_order_of_transitions_and_scenes_changes_nothing(entries: Entries, seed: int) -> None:
    mixed = random.Random(seed).sample(entries, len(entries))
    one, other = learn_operators(labelled(entries)), learn_operators(labelled(mixed))
    assert one.model == other.model
    assert kinds(one) == kinds(other)


def corrected(entries: Entries, seed: int) -> tuple[Entries, int]:
    """One label is another one; and in which entry."""
    chance = random.Random(seed)
    place = chance.randrange(len(entries))
    moment = chance.choice(["before", "after"])
    state = dict(entries[place][moment])
    atom = chance.choice(sorted(state))
    state[atom] = chance.choice([value for value in (True, False, None) if value != state[atom]])
    changed = [*entries]
    changed[place] = {**entries[place], moment: state}
    return changed, place


@QUICK
@given(worlds, st.integers(0, 10**9))
def test_relearning_after_a_correction_is_learning_from_scratch(
    entries: Entries, seed: int
) -> None:
    learner = FaithfulLearner()
    before = learner.learn(labelled(entries))
    assert before.model.predicates == PREDICATES
    changed, _ = corrected(entries, seed)
    again, fresh = learner.learn(labelled(changed)), learn_operators(labelled(changed))
    assert again.model == fresh.model
    assert again.inconsistencies == fresh.inconsistencies
    assert learner.learn(labelled(entries)).model == before.model


@QUICK
@given(worlds, st.integers(0, 10**9))
def test_a_correction_relearns_only_what_it_touches(entries: Entries, seed: int) -> None:
    learned: list[str] = []

    def spy(language, data):
        learned.append(language.skill.name)
        return original(language, data)

    original = faithful.fit_skill
    changed, place = corrected(entries, seed)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(faithful, "fit_skill", spy)
        learner = FaithfulLearner()
        first, second = labelled(entries), labelled(changed)
        assert set(learner.learn(first).skills) == {s.name for s in DOMAIN.skills}
        learned.clear()
        assert set(learner.learn(second).skills) == {s.name for s in DOMAIN.skills}
    if first.varying == second.varying:
        assert set(learned) <= {entries[place]["skill"]}
        assert len(learned) <= 1


def test_a_learner_is_chosen_by_name() -> None:
    assert isinstance(make_learner(LearnerSettings()), FaithfulLearner)
    with pytest.raises(UnknownNameError, match="did you mean 'faithful'"):
        make_learner(LearnerSettings(learner="faitful"))


def test_a_part_of_the_vocabulary_will_do() -> None:
    entries = [step.entry() for step in random_steps(3)]
    fit = learn_operators(labelled(entries), PREDICATES[:2])
    assert fit.predicates == PREDICATES[:2]
    other = Predicate("dark", (), "no window is seen")
    with pytest.raises(UnknownNameError, match="unknown labelled predicate 'dark"):
        learn_operators(labelled(entries), [other])


def test_doubtful_labels_count_as_unknown() -> None:
    def entries(probability: float | bool | None) -> Entries:
        before = {"dark()": probability, "clean(a)": False}
        after = {"dark()": probability, "clean(a)": True}
        step = {"skill": "Use", "arguments": ["r", "a"], "success": True}
        rest = {"skill": "Wait", "success": False, "before": ["clean(a)"], "after": ["clean(a)"]}
        return [{**step, "before": before, "after": after}, rest]

    def model(probability: float | bool | None, least: float = 0.9) -> Any:
        settings = LearnerSettings(least_confidence=least)
        return learn_operators(labelled(entries(probability)), settings=settings).model

    assert model(0.95) == model(True)
    assert model(0.8) == model(None) != model(True)
    assert model(0.8, least=0.7) == model(True)
    assert model(0.05) == model(False)

"""Naming next actions: by what differs between two pictures and by what skills are called."""

from __future__ import annotations

import itertools
from collections import Counter

import pytest
from seen_kitchen import LEXICON, embedded_model, kitchen

from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.embedded import NoiseProfile, noise_profile
from skillwrapper.embedded.acting import differences
from skillwrapper.embedded.facts import Fact, Sort
from skillwrapper.embedded.misreading import Misreading
from skillwrapper.embedded.noise import FactErrors
from skillwrapper.embedded.sight import Sight
from skillwrapper.planning.questions import ActionAnswer, ActionQuestion
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet

QUIET = noise_profile("none")
WRONG = FactErrors(
    sort=Sort.ATTRIBUTE, name="cooked", positives=1, false_negatives=1, negatives=1,
    false_positives=1,
)  # fmt: skip


def act(start: object, end: object, noise: NoiseProfile = QUIET, seed: int = 0) -> ActionAnswer:
    world = kitchen()
    now, goal = world.look(start), world.look(end)
    question = ActionQuestion(world.domain, world.domain.objects, now, goal, ())
    return Assistant(ModelSet.of(embedded_model(seed, noise))).next_actions(question)


def sight(state: object) -> Sight:
    return Sight(kitchen().graph(state), (512, 512), kitchen().look(state).pictures[0].sha256)


def test_differences_are_what_is_otherwise_in_the_goal() -> None:
    start, end = BurgerState(), BurgerState(places=("board", "table", "table", "table"), cut=True)
    found = differences(sight(start), sight(end), LEXICON)
    assert {(d.fact, d.wanted) for d in found} == {
        (Fact(Sort.ATTRIBUTE, "cut", ("lettuce",)), True),
        (Fact(Sort.RELATION, "on", ("lettuce", "board")), True),
        (Fact(Sort.RELATION_TO_KIND, "on", ("lettuce", "table")), False),
    }


def test_all_states_differ() -> None:
    sights = [sight(state) for state in kitchen().states[:40]]
    for first, second in itertools.pairwise(sights):
        assert differences(first, second, LEXICON)
        assert not differences(first, first, LEXICON)


def test_a_skill_is_found_by_what_it_is_called() -> None:
    start = BurgerState(places=("board", "stove", "table", "table"))
    end = BurgerState(places=("board", "stove", "table", "table"), cut=True)
    first = Counter(act(start, end, seed=seed).plan[0].skill for seed in range(30))
    assert first.most_common(1)[0][0] == "Cut"
    assert len(first) > 1  # it guesses


def test_what_no_skill_is_called_for_is_impossible() -> None:
    whole = BurgerState(places=("board", "stove", "table", "table"))
    cut = BurgerState(places=("board", "stove", "table", "table"), cut=True)
    assert act(cut, whole).impossible
    assert not any(act(whole, cut, seed=seed).impossible for seed in range(30))


@pytest.mark.parametrize("noise", [QUIET, noise_profile("0.2")])
def test_the_same_picture_is_done(noise: NoiseProfile) -> None:
    for state in kitchen().sample(10):
        assert act(state, state, noise).done  # one picture is misread in one way only


def test_misread_pictures_mislead() -> None:
    noisy = Misreading(noise_profile("0.2"), 0)
    sights = [sight(state) for state in kitchen().sample(40)]
    pairs = list(itertools.pairwise(sights))
    wrong = sum(
        differences(noisy.of(a, ""), noisy.of(b, ""), LEXICON) != differences(a, b, LEXICON)
        for a, b in pairs
    )
    assert wrong > len(pairs) // 4


def test_an_error_that_is_always_made_makes_no_difference() -> None:
    noise = NoiseProfile(name="test", facts=(WRONG,))
    start, end = kitchen().states[0], kitchen().states[40]
    assert act(start, end, noise) == act(start, end)

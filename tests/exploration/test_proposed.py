"""Choosing the next sequence (paper, Section 3.1; D16)."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from garden import (
    GARDEN,
    MODEL,
    OPEN_LEFT,
    OPEN_RIGHT,
    SEEN,
    SHUT_LEFT,
    SHUT_RIGHT,
    SPACE,
    is_repetitive,
    learned,
    situation,
    state,
)

from skillwrapper.exploration.proposed import SequenceExplorer
from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.world import Episode, Scene, SkillInstance, Transition

SITUATION = situation(state(0, 0))
DAY = [OPEN_LEFT, SHUT_LEFT, OPEN_RIGHT, SHUT_RIGHT]


class Proposer:
    """Proposes what it is told to, and remembers what it was asked."""

    def __init__(self, *sequences: list[SkillInstance], unusable: tuple[str, ...] = ()) -> None:
        self.answer = ProposalAnswer(tuple(map(tuple, sequences)), unusable)
        self.questions: list[ProposalQuestion] = []

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        self.questions.append(question)
        return self.answer


def explorer(proposer: Proposer, seed: int = 0, **settings: object) -> SequenceExplorer:
    chosen = ExplorationSettings(**{"budget": 4, "least_length": 4, **settings})  # type: ignore[arg-type]
    return SequenceExplorer(GARDEN, proposer, chosen, seed)


def episode(*steps: tuple[SkillInstance, bool]) -> Episode:
    transitions = tuple(Transition(SEEN, i, success, SEEN) for i, success in steps)
    return Episode(GARDEN.scene(), 0, transitions)


def test_the_best_by_both_scores_is_chosen() -> None:
    """Half of the skills succeed and all pairs are new, against all succeed or all pairs old."""
    good = [OPEN_LEFT, OPEN_RIGHT, OPEN_LEFT, OPEN_RIGHT]
    helper = explorer(Proposer(DAY, good, [SHUT_LEFT, SHUT_RIGHT] * 2), target_ratio=0.5)
    helper.record(episode(*((i, True) for i in DAY)))
    choice = helper.choose(SITUATION)
    assert [c.balance for c in choice.candidates] == [-0.5, 0.0, -0.5]
    assert choice.candidates[0].coverage < choice.candidates[1].coverage
    assert choice.pareto == (1,)
    assert choice.sequence == tuple(good)
    assert choice.notes == ()


def test_exact_ties_are_drawn_evenly() -> None:
    mirrored = [OPEN_RIGHT, SHUT_RIGHT, OPEN_LEFT, SHUT_LEFT]
    chosen = Counter(
        explorer(Proposer(DAY, mirrored), seed).choose(SITUATION).sequence for seed in range(200)
    )
    assert len(chosen) == 2
    assert min(chosen.values()) > 70


def test_uniform_choice_takes_any() -> None:
    """No Heuristic: also one that another beats."""
    worse = [SHUT_LEFT, SHUT_RIGHT, SHUT_LEFT, SHUT_RIGHT]
    better = [OPEN_LEFT, SHUT_RIGHT, SHUT_LEFT, OPEN_LEFT]
    chosen = {
        explorer(Proposer(worse, better), seed, choice="uniform").choose(SITUATION).sequence
        for seed in range(20)
    }
    assert chosen == {tuple(worse), tuple(better)}


def test_no_usable_proposal() -> None:
    choice = explorer(Proposer(unusable=("line 1: no skill",))).choose(SITUATION)
    assert len(choice.sequence) == 4
    assert choice.notes == (
        "line 1: no skill",
        "no usable sequence was proposed; one is drawn by chance",
    )


def test_proposals_are_repaired_and_it_is_said_how() -> None:
    choice = explorer(Proposer([OPEN_LEFT, OPEN_LEFT, SHUT_LEFT])).choose(SITUATION)
    assert len(choice.sequence) == 4
    assert not is_repetitive(choice.sequence)
    assert choice.notes == (
        "sequence 1: dropped a repetition of Open(left)",
        "sequence 1: added 2 skills by chance at the end",
    )


def test_only_instances_of_the_scene() -> None:
    left = Scene.of("small", ["left"], GARDEN.objects)
    choice = explorer(Proposer(DAY)).choose(situation(state(0), scene=left))
    assert {i.arguments for i in choice.sequence} == {("left",)}


def test_more_than_asked_for_is_not_looked_at() -> None:
    choice = explorer(Proposer(DAY, DAY[::-1]), candidates=1).choose(SITUATION)
    assert len(choice.candidates) == 1


def test_a_sequence_is_as_long_as_the_budget_though_more_is_asked_for() -> None:
    proposer = Proposer(DAY)
    choice = explorer(proposer, budget=2, least_length=4).choose(SITUATION)
    assert proposer.questions[0].length == 4
    assert choice.sequence == (OPEN_LEFT, SHUT_LEFT)


def test_the_question_names_what_was_tried_least_and_what_rarely_worked() -> None:
    """D16"""
    proposer = Proposer(DAY)
    helper = explorer(proposer, named_pairs=3)
    helper.record(episode(*[(OPEN_LEFT, True), (SHUT_LEFT, False)] * 3))
    helper.choose(SITUATION)
    (question,) = proposer.questions
    assert question.scarce_skills == ("Shut",)
    assert len(question.least_explored) == 3
    assert (OPEN_LEFT, SHUT_LEFT) not in question.least_explored
    assert (question.count, question.length) == (5, 4)
    assert question.predicates == MODEL.predicates
    assert len(question.operators) == len(MODEL.operators)


def test_the_question_sets_untested_conditions_apart() -> None:
    proposer = Proposer(DAY)
    explorer(proposer).choose(situation(state(0, 0), fit=learned()))
    explorer(proposer).choose(SITUATION)
    first, second = ("\n".join(q.operators) for q in proposer.questions)
    assert "may need not open(?door)" in first
    assert "may need" not in second


def test_three_successes_are_enough() -> None:
    proposer = Proposer(DAY)
    helper = explorer(proposer)
    for _ in range(3):
        helper.record(episode((OPEN_LEFT, True), (SHUT_LEFT, True)))
    helper.choose(SITUATION)
    assert proposer.questions[0].scarce_skills == ()


@pytest.mark.parametrize("choice", ["pareto", "uniform"])
def test_same_seed_same_choices(choice: str) -> None:
    def choices(seed: int) -> list[tuple[SkillInstance, ...]]:
        helper = explorer(Proposer(DAY, [OPEN_LEFT]), seed, choice=choice)
        return [helper.choose(SITUATION).sequence for _ in range(5)]

    assert choices(1) == choices(1) != choices(2)


def test_unknown_labels_are_no_obstacle() -> None:
    unknown = np.full(len(SPACE.atoms), -1, dtype=np.int8)
    choice = explorer(Proposer(DAY)).choose(situation(unknown))
    assert choice.candidates[0].balance == -0.5


def test_a_sequence_is_run_to_its_end_and_told_once() -> None:
    proposer = Proposer(DAY)
    helper, done = explorer(proposer), []
    for position in range(5):
        chosen = helper.next_skill(situation(state(0, 0), *done))
        assert chosen.reason
        assert (chosen.sequence is not None) == (position == 0)
        done += [chosen.instance] if chosen.instance else []
    assert done == DAY
    assert len(proposer.questions) == 1

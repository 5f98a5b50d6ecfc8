"""The embedded model, asked through the assistant with pictures of the burger kitchen."""

from __future__ import annotations

import itertools
from collections import Counter
from dataclasses import replace

import pytest
from seen_kitchen import EXPERT, LEXICON, embedded_model, kitchen

from skillwrapper.embedded import EmbeddedModel, NoiseProfile
from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.invention.questions import (
    BatchInventionQuestion,
    InventionQuestion,
    RephrasingQuestion,
)
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.planning.questions import ActionQuestion
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.world import Observation, Picture, Transition

CONCEPT_BY_NAME = {
    name: concept
    for concept in LEXICON.concepts(kitchen().graph(kitchen().states[0]).outline)
    for name in concept.wording.names
}


def assistant(seed: int = 0, noise: NoiseProfile | None = None) -> Assistant:
    return Assistant(ModelSet.of(embedded_model(seed, noise)))


def evaluation(state: object, predicates: tuple[Predicate, ...] = EXPERT) -> EvaluationQuestion:
    world = kitchen()
    picture = world.look(state)
    return EvaluationQuestion(world.domain, world.domain.objects, picture, predicates)


def test_without_noise_every_label_is_right() -> None:
    states = kitchen().sample(60)
    answers = assistant().evaluate([evaluation(state) for state in states])
    for state, answer in zip(states, answers, strict=True):
        assert {atom for atom, label in answer.labels.items() if label} == kitchen().true_atoms(
            state
        )
        assert None not in answer.labels.values()


def test_what_is_not_understood_is_unknown() -> None:
    mood = Predicate("is_happy", ("pickupable",), "The ingredient is in a good mood.")
    (answer,) = assistant().evaluate([evaluation(kitchen().states[0], (mood,))])
    assert set(answer.labels.values()) == {None}


def test_a_picture_of_something_else_is_not_guessed_at() -> None:
    question = evaluation(kitchen().states[0])
    blank = Observation((Picture(b"not even a picture"),))
    other = EvaluationQuestion(question.domain, question.objects, blank, EXPERT)
    (answer,) = assistant().evaluate([other])
    assert set(answer.labels.values()) == {None}


def invention(
    kind: InconsistencyKind,
    first: Transition,
    second: Transition | None,
    *known: Predicate,
    rejected: tuple[Predicate, ...] = (),
    unexplained: tuple[Atom, ...] = (),
    count: int = 3,
) -> InventionQuestion:
    domain = kitchen().domain
    skill = domain.skill_by_name[first.instance.skill]
    types = tuple(dict.fromkeys(p.type for p in skill.parameters))
    return InventionQuestion(
        domain, skill, kind, first, second, types, unexplained, known, rejected, count
    )


def tell_apart(question: InventionQuestion, predicate: Predicate) -> bool:
    """Whether a predicate over the skill's arguments separates the two witnesses."""
    assert question.second is not None
    domain, helper = question.domain, assistant()
    found = []
    for transition in (question.first, question.second):
        ask = [
            EvaluationQuestion(domain, domain.objects, picture, (predicate,))
            for picture in (transition.before, transition.after)
        ]
        before, after = helper.evaluate(ask)
        roles = itertools.permutations(transition.instance.arguments, predicate.arity)
        atoms = [atom for terms in roles if (atom := Atom(predicate.name, terms)) in before.labels]
        if question.kind is InconsistencyKind.EFFECT:
            found.append([before.labels[a] is not after.labels[a] for a in atoms])
        else:
            found.append([before.labels[a] is True for a in atoms])
    return found[0] != found[1]


@pytest.mark.parametrize("kind", [InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT])
@pytest.mark.parametrize("skill", ["Pick", "Place", "Stack", "Cut", "Cook"])
def test_proposed_predicates_tell_the_pictures_apart(kind: InconsistencyKind, skill: str) -> None:
    for seed in range(3):
        question = invention(
            kind,
            kitchen().find(skill, success=True, seed=seed),
            kitchen().find(skill, success=False, seed=seed),
        )
        answer = assistant(seed).invent_predicates(question)
        assert answer.predicates
        assert not answer.unusable
        for predicate in answer.predicates:
            assert set(predicate.types) <= set(question.types)
            assert tell_apart(question, predicate), predicate


def test_known_and_rejected_ideas_are_not_proposed_in_other_words() -> None:
    success = kitchen().find("Cut", success=True, seed=1)
    failure = kitchen().find("Cut", success=False, seed=1)
    known = Predicate("in_bits", ("cuttable",), "The thing is cut into pieces.")
    rejected = Predicate("gripper_empty", ("robot",), "The gripper holds nothing.")
    for seed in range(10):
        question = invention(
            InconsistencyKind.EFFECT, success, failure, known, rejected=(rejected,)
        )
        for predicate in assistant(seed).invent_predicates(question).predicates:
            assert CONCEPT_BY_NAME[predicate.name].idea not in {"cut", "nothing held"}


def test_a_known_idea_for_more_types_keeps_its_name_and_meaning() -> None:
    known = Predicate("bare", ("cuttable",), "Nothing lies on the cuttable.")
    question = invention(
        InconsistencyKind.PRECONDITION,
        kitchen().find("Pick", success=True, seed=5),
        kitchen().find("Pick", success=False, seed=5),
        known,
        count=30,
    )
    found = {p.name: p for p in assistant().invent_predicates(question).predicates}
    if "bare" in found:
        assert found["bare"].types == ("pickupable",)
        assert found["bare"].semantics == known.semantics
    assert not {"top_clear", "uncovered", "nothing_on_top", "covered"} & set(found)


def test_local_relations_come_first_but_not_alone() -> None:
    local = Counter[bool]()
    for seed in range(40):
        question = invention(
            InconsistencyKind.PRECONDITION,
            kitchen().find("Stack", success=True, seed=seed),
            kitchen().find("Stack", success=False, seed=seed),
            count=1,
        )
        for predicate in assistant(seed).invent_predicates(question).predicates:
            local[CONCEPT_BY_NAME[predicate.name].local] += 1
    assert 0.55 < local[True] / local.total() < 0.95


def test_an_unexplained_change_leads_to_a_relation() -> None:
    world = kitchen()
    clear = Predicate("top_clear", ("pickupable",), "nothing lies on the pickupable")
    found = Counter[str]()
    for state in world.sample(80):
        stacked = [a for a in world.true_atoms(state) if a.predicate == "stacked_on"]
        for upper, lower in (atom.terms for atom in stacked):
            pick = next(i for i in world.domain.skill_instances if i.arguments == ("robot", upper))
            if not world.environment.successor(state, pick)[0]:
                continue
            question = invention(
                InconsistencyKind.UNEXPLAINED,
                world.transition(state, pick),
                None,
                clear,
                unexplained=(Atom("top_clear", (lower,)),),
                count=1,
            )
            for predicate in assistant().invent_predicates(question).predicates:
                assert predicate.types == ("pickupable", "pickupable")
                found[CONCEPT_BY_NAME[predicate.name].idea] += 1
    assert found.most_common(1)[0][0] == "on"


@pytest.mark.parametrize("skill", ["Pick", "Place", "Stack", "Cut", "Cook"])
def test_what_one_execution_has_changed(skill: str) -> None:
    """D26"""
    done = kitchen().find(skill, success=True, seed=1)
    question = invention(InconsistencyKind.UNNOTICED, done, None)
    answer = assistant().invent_predicates(question)
    assert answer.predicates
    for predicate in answer.predicates:
        domain, seen = kitchen().domain, (done.before, done.after)
        ask = [EvaluationQuestion(domain, domain.objects, o, (predicate,)) for o in seen]
        before, after = assistant().evaluate(ask)
        changed = [a for a, label in before.labels.items() if label is not after.labels[a]]
        assert any(set(a.terms) <= set(done.instance.arguments) for a in changed), predicate


def test_where_nothing_has_changed_it_says_so() -> None:
    done = kitchen().find("Cook", success=True, seed=1)
    question = invention(InconsistencyKind.UNNOTICED, replace(done, after=done.before), None)
    answer = assistant().invent_predicates(question)
    assert (answer.predicates, answer.unusable) == ((), ())


@pytest.mark.parametrize(
    ("candidate", "meaning"),
    [
        ("on_board", "The cuttable lies on the board."),
        ("on_a_station", "The cuttable lies on a station."),
    ],
)
def test_a_candidate_in_general_terms(candidate: str, meaning: str) -> None:
    given = Predicate(candidate, ("cuttable",), meaning)
    question = RephrasingQuestion(kitchen().domain, given, ("cuttable", "station"))
    (said,) = assistant().rephrase_predicate(question).predicates
    assert said.types == ("cuttable", "station")
    assert said.semantics.rstrip(".") == "The cuttable lies on the station"


def test_a_whole_vocabulary() -> None:
    world = kitchen()
    pictures = tuple(world.look(state) for state in world.sample(30))
    answer = assistant().invent_batch(BatchInventionQuestion(world.domain, pictures, 15))
    assert len(answer.predicates) == 15
    assert not answer.unusable


def proposal() -> ProposalQuestion:
    domain = kitchen().domain
    pick, other = domain.skill_instances[0], domain.skill_instances[9]
    start = kitchen().look(kitchen().states[0])
    return ProposalQuestion(domain, domain.objects, start, (), (), ((pick, other),), (), 20, 30)


def test_sequences_are_as_many_and_as_long_as_wanted() -> None:
    answer = assistant().propose_sequences(proposal())
    assert [len(s) for s in answer.sequences] == [30] * 20
    assert not answer.unusable
    assert len(set(answer.sequences)) == 20


def test_the_least_explored_pairs_are_brought_about() -> None:
    question = proposal()
    answer = assistant().propose_sequences(question)
    named = set(question.least_explored)
    assert all(named & set(itertools.pairwise(sequence)) for sequence in answer.sequences)


def test_the_same_step_seldom_comes_twice_in_a_row() -> None:
    answer = assistant().propose_sequences(proposal())
    repeats = [a == b for s in answer.sequences for a, b in itertools.pairwise(s)]
    assert sum(repeats) / len(repeats) < 0.1


def test_next_actions_are_about_what_differs_and_done_if_nothing_does() -> None:
    world = kitchen()
    start, end = world.states[0], world.states[40]
    now, goal = (world.look(state) for state in (start, end))
    question = ActionQuestion(world.domain, world.domain.objects, now, goal, ())
    moved = {t for a in world.true_atoms(start) ^ world.true_atoms(end) for t in a.terms}

    answer = assistant().next_actions(question)

    assert answer.plan
    assert set(answer.plan[0].arguments) & moved
    same = ActionQuestion(world.domain, world.domain.objects, now, now, ())
    assert assistant().next_actions(same).done


def test_the_same_seed_and_prompt_give_the_same_reply_whatever_was_asked_before() -> None:
    question = invention(
        InconsistencyKind.PRECONDITION,
        kitchen().find("Pick", success=True, seed=2),
        kitchen().find("Pick", success=False, seed=2),
    )
    used, fresh = assistant(7), assistant(7)
    used.propose_sequences(proposal())
    assert used.invent_predicates(question) == fresh.invent_predicates(question)
    others = {assistant(seed).invent_predicates(question).predicates for seed in range(8)}
    assert len(others) > 1


def test_neither_role_nor_repetition_matter() -> None:
    model = EmbeddedModel()
    prompt = '## Text\n"""\nis_cut(lettuce) is true.\n"""'
    one = model.complete(ModelRequest(Role.ACT, "", prompt))
    two = model.complete(ModelRequest(Role.SUMMARISE, "", prompt, repetition=3))
    assert one.text == two.text


def test_other_prompts_are_answered_too() -> None:
    reply = EmbeddedModel().complete(ModelRequest(Role.ACT, "", "What is the time?"))
    assert "only answer" in reply.text

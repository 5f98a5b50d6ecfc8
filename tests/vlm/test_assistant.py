"""The assistant, asked with scripted models."""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable
from dataclasses import replace

import pytest
from pydantic import ValidationError
from scripted import ScriptedModel, section

from skillwrapper.errors import ConfigurationError, ModelUnavailableError
from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.invention.questions import BatchInventionQuestion, InventionQuestion
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.planning.questions import ActionQuestion
from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.evaluation import majority
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.vlm.settings import AskingSettings
from skillwrapper.world import Domain, Observation, Picture, SkillInstance, Transition

HOLDING = Predicate("holding", ("robot", "pickupable"), "the item is in the hand")
IS_CUT = Predicate("is_cut", ("cuttable",), "the item is in pieces")
PICK = SkillInstance("Pick", ("robot", "patty"))


def picture(name: str) -> Observation:
    return Observation((Picture(name.encode()),))


def assistant(
    answer: Callable[[ModelRequest], str], **settings: int | float
) -> tuple[Assistant, ScriptedModel]:
    model = ScriptedModel(answer)
    made = AskingSettings(**settings)  # type: ignore[arg-type]
    return Assistant(ModelSet.of(model), settings=made), model


def evaluation(domain: Domain, name: str = "a", *predicates: Predicate) -> EvaluationQuestion:
    chosen = predicates or (HOLDING, IS_CUT)
    return EvaluationQuestion(domain, domain.objects, picture(name), chosen)


def all_true(request: ModelRequest) -> str:
    """Stage one: anything; stage two: every statement is true."""
    if request.role is Role.EVALUATE:
        return "I see the robot. All of that is so."
    return "\n".join(f"{atom}: true" for atom in section(request.prompt, "Statements"))


def test_evaluation_has_two_stages_and_only_the_first_sees_the_picture(burger: Domain) -> None:
    helper, model = assistant(all_true)

    (answer,) = helper.evaluate([evaluation(burger)])

    assert set(answer.labels) == set(all_groundings([HOLDING, IS_CUT], burger.objects))
    assert set(answer.labels.values()) == {True}
    assert [r.role for r in model.requests] == [Role.EVALUATE, Role.SUMMARISE]
    assert model.requests[0].pictures == picture("a").pictures
    assert model.requests[1].pictures == ()
    assert "All of that is so." in model.requests[1].prompt


@pytest.mark.parametrize(
    ("summarise", "roles"),
    [("when-needed", [Role.EVALUATE]), ("always", [Role.EVALUATE, Role.SUMMARISE])],
)
def test_a_judgement_that_is_clear_needs_no_summary(
    burger: Domain, summarise: str, roles: list[Role]
) -> None:
    def clear(request: ModelRequest) -> str:
        atoms = section(request.prompt, "Statements")
        return "I see it.\n\n" + "\n".join(f"- {atom} is true." for atom in atoms)

    helper, model = assistant(clear, summarise=summarise)
    (answer,) = helper.evaluate([evaluation(burger)])
    assert set(answer.labels.values()) == {True}
    assert [r.role for r in model.requests] == roles


@pytest.mark.parametrize("flaw", ["", "\nBut {} is false, I think.", None])
def test_a_judgement_with_one_doubt_is_summed_up(burger: Domain, flaw: str | None) -> None:
    """One statement is left out, or judged both ways."""

    def unclear(request: ModelRequest) -> str:
        atoms = section(request.prompt, "Statements")
        said = [f"{atom}: true" for atom in atoms]
        if request.role is Role.SUMMARISE or flaw is None:
            return "\n".join(said)
        return "\n".join(said) + flaw.format(atoms[0]) if flaw else "\n".join(said[1:])

    helper, model = assistant(unclear)
    (answer,) = helper.evaluate([evaluation(burger)])
    assert set(answer.labels.values()) == {True}
    assert len(model.requests) == (1 if flaw is None else 2)


def test_every_grounding_and_meaning_is_in_the_first_prompt(burger: Domain) -> None:
    helper, model = assistant(all_true)
    helper.evaluate([evaluation(burger)])

    prompt = model.requests[0].prompt
    expected = [str(a) for a in all_groundings([HOLDING, IS_CUT], burger.objects)]
    assert section(prompt, "Statements") == expected
    assert "holding(?robot, ?pickupable): the item is in the hand" in prompt


def test_groundings_are_asked_in_batches_of_bounded_size(burger: Domain) -> None:
    helper, model = assistant(all_true, batch_size=2)

    (answer,) = helper.evaluate([evaluation(burger)])

    sizes = [len(section(r.prompt, "Statements")) for r in model.requests]
    assert sizes == [2, 2, 2, 2, 1, 1]
    assert len(answer.labels) == 5


def test_missing_groundings_alone_are_asked_again_and_are_then_unknown(burger: Domain) -> None:
    def never_the_patty(request: ModelRequest) -> str:
        return "\n".join(line for line in all_true(request).splitlines() if "patty" not in line)

    helper, model = assistant(never_the_patty, reasks=2)

    (answer,) = helper.evaluate([evaluation(burger)])

    missing = Atom("holding", ("robot", "patty"))
    assert [a for a, label in answer.labels.items() if label is None] == [missing]
    assert len(model.requests) == 6
    assert [r.repetition for r in model.requests] == [0, 0, 1, 1, 2, 2]
    assert section(model.requests[2].prompt, "Statements") == [str(missing)]
    assert "no clear judgement on holding(robot, patty)" in model.requests[2].prompt


def test_a_first_reply_about_nothing_is_asked_for_again(burger: Domain) -> None:
    def nonsense_at_first(request: ModelRequest) -> str:
        if request.role is Role.EVALUATE and request.repetition < 2:
            return "Colourless green ideas sleep furiously."
        return all_true(request)

    helper, model = assistant(nonsense_at_first)
    (answer,) = helper.evaluate([evaluation(burger)])
    assert set(answer.labels.values()) == {True}
    roles = [(r.role, r.repetition) for r in model.requests]
    assert roles == [(Role.EVALUATE, n) for n in range(3)] + [(Role.SUMMARISE, 2)]


def test_replies_of_no_use_are_bounded(burger: Domain) -> None:
    helper, model = assistant(lambda _: "No.", unusable_reasks=3)
    (answer,) = helper.evaluate([evaluation(burger)])
    assert set(answer.labels.values()) == {None}
    assert len(model.requests) == 4


def test_unsure_is_an_answer_and_not_asked_again(burger: Domain) -> None:
    helper, model = assistant(lambda request: all_true(request).replace("true", "unsure"))
    (answer,) = helper.evaluate([evaluation(burger)])
    assert set(answer.labels.values()) == {None}
    assert len(model.requests) == 2


def test_an_empty_vocabulary_needs_no_call(burger: Domain) -> None:
    helper, model = assistant(all_true)
    question = EvaluationQuestion(burger, burger.objects, picture("a"), ())
    assert helper.evaluate([question, question])[1].labels == {}
    assert model.requests == []


def label_by_picture(request: ModelRequest) -> str:
    if request.role is Role.EVALUATE:
        return f"{request.pictures[0].png.decode()} patty"
    word = "true" if '"""\neven' in request.prompt else "false"
    return "\n".join(f"{atom}: {word}" for atom in section(request.prompt, "Statements"))


def test_parallel_answers_do_not_depend_on_the_order_of_arrival(burger: Domain) -> None:
    def slow_at_first(request: ModelRequest) -> str:
        time.sleep(random.Random(request.prompt).random() / 100)
        return label_by_picture(request)

    names = [f"{'even' if n % 2 == 0 else 'odd'} {n}" for n in range(12)]
    questions = [evaluation(burger, name) for name in names]
    together, _ = assistant(slow_at_first, parallel=8)
    alone, _ = assistant(label_by_picture, parallel=1)

    answers = together.evaluate(questions)

    assert answers == alone.evaluate(questions)
    assert [set(a.labels.values()) == {True} for a in answers] == [n % 2 == 0 for n in range(12)]


def test_one_wave_keeps_the_allowed_number_of_calls_in_flight(burger: Domain) -> None:
    lock, now, most = threading.Lock(), 0, 0

    def counted(request: ModelRequest) -> str:
        nonlocal now, most
        with lock:
            now += 1
            most = max(most, now)
        time.sleep(0.01)
        with lock:
            now -= 1
        return all_true(request)

    helper, _ = assistant(counted, parallel=4)
    helper.evaluate([evaluation(burger, str(n)) for n in range(12)])
    assert most == 4


def test_one_at_a_time_uses_no_threads(burger: Domain) -> None:
    here = threading.get_ident()

    def same_thread(request: ModelRequest) -> str:
        assert threading.get_ident() == here
        return all_true(request)

    helper, _ = assistant(same_thread)
    helper.evaluate([evaluation(burger, "a"), evaluation(burger, "b")])


def test_a_provider_error_ends_the_wave(burger: Domain) -> None:
    def unavailable(request: ModelRequest) -> str:
        raise ModelUnavailableError("gone")

    helper, model = assistant(unavailable, parallel=4)
    with pytest.raises(ModelUnavailableError, match="gone"):
        helper.evaluate([evaluation(burger, str(n)) for n in range(40)])
    assert len(model.requests) <= 40


def test_votes_decide_by_majority_and_agreement_is_told(burger: Domain) -> None:
    def wavering(request: ModelRequest) -> str:
        word = "false" if request.repetition == 7 else "true"
        return all_true(request).replace("true", word)

    helper, model = assistant(wavering, votes=3)

    (answer,) = helper.evaluate([evaluation(burger, "a", IS_CUT)])

    atom = Atom("is_cut", ("lettuce",))
    assert answer.labels == {atom: True}
    assert answer.agreement == {atom: pytest.approx(2 / 3)}
    assert {r.repetition for r in model.requests} == {0, 7, 14}


@pytest.mark.parametrize(
    ("votes", "margin", "label"),
    [
        ([True], 0.0, True),
        ([True, False], 0.0, None),
        ([True, True, False], 0.0, True),
        ([True, True, False], 0.5, None),
        ([False, False, None], 0.5, False),
        ([None, None, True], 0.0, True),
        ([None, None, True], 0.5, None),
        ([None], 0.0, None),
    ],
)
def test_majority(votes: list[bool | None], margin: float, label: bool | None) -> None:
    assert majority(votes, margin)[0] is label


def proposal(domain: Domain) -> ProposalQuestion:
    return ProposalQuestion(
        domain, domain.objects, picture("a"), (HOLDING,), ("Pick_1: ...",), ((PICK, PICK),),
        ("Cut",), 2, 15,
    )  # fmt: skip


def test_sequences_are_asked_again_when_the_reply_holds_none(burger: Domain) -> None:
    replies = iter(["I would rather not.", "Sequence 1:\nPick(robot, patty)\nFly(robot)"])
    helper, model = assistant(lambda _: next(replies))

    answer = helper.propose_sequences(proposal(burger))

    assert answer.sequences == ((PICK,),)
    assert "no skill 'Fly'" in answer.unusable[0]
    assert [r.repetition for r in model.requests] == [0, 1]
    assert "I would rather not." in model.requests[1].prompt


def test_the_proposal_prompt_names_hints(burger: Domain) -> None:
    helper, model = assistant(lambda _: "Pick(robot, patty)")
    helper.propose_sequences(proposal(burger))
    prompt = model.requests[0].prompt
    assert section(prompt, "Least explored pairs") == ["Pick(robot, patty) then Pick(robot, patty)"]
    assert section(prompt, "Skills that seldom worked so far") == ["Cut"]
    assert section(prompt, "What is known of the skills") == ["Pick_1: ..."]
    assert "Plan 2 different sequences" in prompt
    assert "at least 15 skills" in prompt


def test_giving_up_after_a_bounded_number_of_unusable_replies(burger: Domain) -> None:
    helper, model = assistant(lambda _: "no", unusable_reasks=3)
    answer = helper.propose_sequences(proposal(burger))
    assert answer.sequences == ()
    assert answer.unusable
    assert len(model.requests) == 4


def invention(domain: Domain, kind: InconsistencyKind) -> InventionQuestion:
    first = Transition(picture("before 1"), PICK, True, picture("after 1"))
    second = Transition(picture("before 2"), PICK, False, picture("after 2"))
    alone = kind in (InconsistencyKind.UNEXPLAINED, InconsistencyKind.UNNOTICED)
    return InventionQuestion(
        domain=domain,
        skill=domain.skill_by_name["Pick"],
        kind=kind,
        first=first,
        second=None if alone else second,
        types=("robot", "pickupable"),
        unexplained=(Atom("clear", ("lettuce",)),) if alone else (),
        current=(HOLDING,),
        rejected=(Predicate("near", ("robot", "pickupable"), "close by"),),
        count=2,
    )


@pytest.mark.parametrize(
    ("kind", "shown"),
    [
        (InconsistencyKind.PRECONDITION, ["before 1", "before 2"]),
        (InconsistencyKind.EFFECT, ["before 1", "after 1", "before 2", "after 2"]),
        (InconsistencyKind.DETERMINISM, ["before 1", "before 2"]),
        (InconsistencyKind.UNEXPLAINED, ["before 1", "after 1"]),
    ],
)
def test_every_kind_of_invention_shows_its_moments(
    burger: Domain, kind: InconsistencyKind, shown: list[str]
) -> None:
    helper, model = assistant(lambda _: "hand_free(?robot): the hand holds nothing.")

    answer = helper.invent_predicates(invention(burger, kind))

    assert answer.predicates == (Predicate("hand_free", ("robot",), "the hand holds nothing."),)
    assert answer.predicates[0].semantics == "the hand holds nothing."
    request = model.requests[0]
    assert [p.png.decode() for p in request.pictures] == shown
    assert "1. Pick(robot, patty) succeeded." in request.prompt
    assert section(request.prompt, "Known predicates")[0].startswith("holding(")
    assert section(request.prompt, "Rejected candidates")[0].startswith("near(")


def test_two_of_a_type_only_where_the_question_allows_it(burger: Domain) -> None:
    def both(_: ModelRequest) -> str:
        return "on(?pickupable, ?pickupable): the first lies on the second."

    helper, _ = assistant(both)
    unexplained = helper.invent_predicates(invention(burger, InconsistencyKind.UNEXPLAINED))
    precondition = helper.invent_predicates(invention(burger, InconsistencyKind.PRECONDITION))

    assert [p.name for p in unexplained.predicates] == ["on"]
    assert precondition.predicates == ()


def test_known_and_rejected_predicates_are_no_candidates(burger: Domain) -> None:
    def old_and_new(_: ModelRequest) -> str:
        return "\n".join(
            [
                "holding(?robot, ?pickupable): held.",
                "near(?robot, ?pickupable): close.",
                "hand_free(?robot): holds nothing.",
                "covered(?pickupable): something lies on it.",
                "third(?pickupable): one too many.",
            ]
        )

    helper, _ = assistant(old_and_new)
    answer = helper.invent_predicates(invention(burger, InconsistencyKind.PRECONDITION))
    assert [p.name for p in answer.predicates] == ["hand_free", "covered"]
    assert any("known or rejected" in reason for reason in answer.unusable)


def test_a_whole_vocabulary_at_once(burger: Domain) -> None:
    helper, model = assistant(
        lambda _: "is_cut(?cuttable): in pieces.\nlies_on(?pickupable, ?station): lies there."
    )
    answer = helper.invent_batch(
        BatchInventionQuestion(burger, (picture("a"), picture("b"), picture("c")), 20)
    )
    assert [p.signature for p in answer.predicates] == [
        "is_cut(?cuttable)",
        "lies_on(?pickupable, ?station)",
    ]
    assert len(model.requests[0].pictures) == 3


def test_next_actions(burger: Domain) -> None:
    helper, model = assistant(lambda _: "Take the patty.\n\nPick(robot, patty)\nDone")
    answer = helper.next_actions(
        ActionQuestion(burger, burger.objects, picture("a"), picture("b"), ((PICK, False),))
    )
    assert answer.plan == (PICK,)
    assert not answer.done
    assert section(model.requests[0].prompt, "Run so far") == ["Pick(robot, patty) failed"]


def test_several_cameras_are_told_apart(burger: Domain) -> None:
    helper, model = assistant(all_true)
    cameras = Observation((Picture(b"1", "left"), Picture(b"2", "right")))
    helper.evaluate([EvaluationQuestion(burger, burger.objects, cameras, (IS_CUT,))])
    assert section(model.requests[0].prompt, "Pictures") == [
        "Picture 1: the scene, camera left",
        "Picture 2: the scene, camera right",
    ]


def test_every_role_needs_a_model() -> None:
    model = ScriptedModel(lambda _: "")
    with pytest.raises(ConfigurationError, match="expected a model for every role"):
        Assistant({Role.ACT: model})
    with pytest.raises(ConfigurationError, match="unknown role 'judge'"):
        ModelSet.of(model, judge=model)


@pytest.mark.parametrize(
    ("name", "value"), [("parallel", 0), ("batch_size", 0), ("reasks", -1), ("margin", 2.0)]
)
def test_settings_are_checked(name: str, value: float) -> None:
    with pytest.raises(ValidationError, match=name):
        AskingSettings(**{name: value})  # type: ignore[arg-type]


class ForgettingModel(ScriptedModel):
    """Remembers which replies were of no use."""

    def take_back(self, request: ModelRequest) -> None:
        self.requests.remove(request)


def test_models_that_keep_replies_are_told_which_were_of_no_use(burger: Domain) -> None:
    replies = iter(["nothing", "Pick(robot, patty)", "A robot.", "No idea.", "I will not."])
    model = ForgettingModel(lambda _: next(replies))
    helper = Assistant(ModelSet.of(model), settings=AskingSettings(unusable_reasks=1))

    helper.propose_sequences(proposal(burger))
    helper.evaluate([evaluation(burger)])

    assert [(r.role, r.repetition) for r in model.requests] == [(Role.PROPOSE, 1)]


@pytest.mark.parametrize(
    ("reply", "calls"),
    [
        ("The patty looks the same.\n\nNothing", 1),
        ("**Nothing.**", 1),
        ("Nothing that I could name, sorry", 2),
    ],
)
def test_nothing_is_an_answer_where_a_skill_may_change_nothing(
    burger: Domain, reply: str, calls: int
) -> None:
    """D26"""
    helper, model = assistant(lambda _: reply, unusable_reasks=1)
    found = helper.invent_predicates(invention(burger, InconsistencyKind.UNNOTICED))
    assert found.predicates == ()
    assert len(model.requests) == calls
    assert [p.png.decode() for p in model.requests[0].pictures] == ["before 1", "after 1"]


def test_nothing_is_no_answer_where_something_must_differ(burger: Domain) -> None:
    helper, model = assistant(lambda _: "Nothing", unusable_reasks=1)
    helper.invent_predicates(invention(burger, InconsistencyKind.EFFECT))
    assert len(model.requests) == 2


def test_two_moments_far_apart_are_said_to_be_so(burger: Domain) -> None:
    """D26"""
    helper, model = assistant(lambda _: "Nothing")
    question = invention(burger, InconsistencyKind.UNNOTICED)
    helper.invent_predicates(question)
    helper.invent_predicates(replace(question, wide=True, long=True))
    once, apart = (request.prompt for request in model.requests)
    assert "The robot ran one of its skills, and it worked." in once
    assert "Between the two pictures the robot ran several of its skills" in apart
    assert "The robot ran one of its skills, and it worked." not in apart

"""From an inconsistency to a question (D1: which types an invented predicate may have)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

from skillwrapper.invention.proposer import ModelProposer
from skillwrapper.invention.questions import (
    InventionAnswer,
    InventionQuestion,
    RephrasingQuestion,
)
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world import (
    Domain,
    Episode,
    Object,
    Observation,
    Parameter,
    Picture,
    Skill,
    SkillInstance,
    Transition,
    TypeHierarchy,
)

KITCHEN = Domain(
    name="kitchen",
    agent="A robot.",
    description="A kitchen.",
    types=TypeHierarchy({"robot": (), "item": (), "place": (), "stove": ("place",)}),
    objects=(
        Object("r", ("robot",)),
        Object("soup", ("item",)),
        Object("stove", ("place", "stove")),
    ),
    skills=(
        Skill(
            "Swap",
            (Parameter("robot", "robot"), Parameter("one", "item"), Parameter("two", "item")),
        ),
    ),
)
SWAP = SkillInstance("Swap", ("r", "soup", "soup"))
KNOWN, BAD, NEW = (Predicate(name, ()) for name in ("known", "bad", "new"))


class Adviser:
    def __init__(self, *proposed: Predicate, said: Sequence[Predicate] = ()) -> None:
        self.proposed, self.said = proposed or (NEW,), tuple(said)
        self.questions: list[InventionQuestion] = []
        self.rephrasings: list[RephrasingQuestion] = []

    def invent_predicates(self, question: InventionQuestion) -> InventionAnswer:
        self.questions.append(question)
        return InventionAnswer(self.proposed, ("line 2: no predicate",))

    def rephrase_predicate(self, question: RephrasingQuestion) -> InventionAnswer:
        self.rephrasings.append(question)
        return InventionAnswer(self.said)


def transition(number: int, success: bool) -> Transition:
    before, after = (Observation((Picture(f"{number}{w}".encode()),)) for w in "ab")
    return Transition(before, SWAP, success, after)


def ask(
    kind: InconsistencyKind, *unexplained: Atom
) -> tuple[InventionQuestion, tuple[Transition, ...]]:
    recorded = RecordedTransitions(KITCHEN)
    transitions = (transition(0, True), transition(1, False))
    recorded.add(Episode(KITCHEN.scene(), 0, transitions))
    second = None if kind is InconsistencyKind.UNEXPLAINED else 1
    one = Inconsistency(kind, "Swap", 0, second, 0, ("Swap", kind, (), ()), unexplained)
    adviser = Adviser()
    found = ModelProposer(recorded, adviser, LearningSettings(candidates=4)).propose(
        one, [KNOWN], [BAD], attempt=2
    )
    assert found == (NEW,)
    return adviser.questions[0], transitions


@pytest.mark.parametrize(
    "kind", [k for k in InconsistencyKind if k not in ("unexplained", "unnoticed")]
)
def test_two_transitions_and_the_types_of_the_skill(kind: InconsistencyKind) -> None:
    question, transitions = ask(kind)
    assert (question.first, question.second) == transitions
    assert question.types == ("robot", "item")
    assert question.kind is kind
    assert question.skill.name == "Swap"
    assert (question.current, question.rejected) == ((KNOWN,), (BAD,))
    assert (question.count, question.attempt) == (4, 2)


def test_an_unexplained_change_adds_the_types_of_its_objects() -> None:
    free = Atom("free", ("stove",))
    question, transitions = ask(InconsistencyKind.UNEXPLAINED, free)
    assert (question.first, question.second) == (transitions[0], None)
    assert question.types == ("robot", "item", "place", "stove")
    assert question.unexplained == (free,)


@pytest.mark.parametrize(
    ("said", "wanted"),
    [
        ([Predicate("rests", ("item", "place"), "the item rests on the place")], "rests"),
        ([Predicate("rests", ("item",), "the item rests")], "on_place"),
        ([Predicate("rests", ("item", "place"), "the item rests on the rack")], "on_place"),
        ([], "on_place"),
    ],
)
def test_a_lifted_candidate_is_said_in_words_of_the_model(
    said: list[Predicate], wanted: str
) -> None:
    """D8; where these are of no use, words are replaced."""
    adviser = Adviser(Predicate("on_shelf", ("item",), "the item rests on the shelf"), said=said)
    places = (Object("shelf", ("place",)), Object("rack", ("place",)))
    kitchen = replace(KITCHEN, objects=(*KITCHEN.objects, *places))
    recorded = RecordedTransitions(kitchen)
    recorded.add(Episode(kitchen.scene(), 0, (transition(0, True), transition(1, False))))
    kind = InconsistencyKind.PRECONDITION
    one = Inconsistency(kind, "Swap", 0, 1, 1, ("Swap", kind, (), ()))
    for settings, asked in ((LearningSettings(), 1), (LearningSettings(rephrase=False), 0)):
        adviser.rephrasings.clear()
        proposer = ModelProposer(recorded, adviser, settings)
        for _ in range(2):
            (found,) = proposer.propose(one, [], [], attempt=0)
            assert found.types == ("item", "place")
            assert found.name == (wanted if asked else "on_place")
        assert len(adviser.rephrasings) == asked

"""Concepts for things of any kind: relations, attributes and conditions that a reader reports."""

from __future__ import annotations

import itertools
import json
import struct

import pytest
from turns import in_turn

from skillwrapper.embedded import Box, EmbeddedModel, SceneGraph, Thing, Words
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.sight import Sight
from skillwrapper.errors import PictureError
from skillwrapper.invention.questions import InventionQuestion
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.world import (
    Domain,
    Object,
    Observation,
    Parameter,
    Picture,
    Skill,
    SkillInstance,
    Transition,
    TypeHierarchy,
)

KINDS = {"anna": "person", "mug": "cup", "glass": "cup", "cupboard": "cupboard",
         "kettle": "appliance", "socket": "socket"}  # fmt: skip
THINGS = tuple(Thing(n, k, Box(9 * i, 0, 9 * i + 8, 9)) for i, (n, k) in enumerate(KINDS.items()))
GRAPH = SceneGraph(
    THINGS,
    relations={
        "held": {("mug", "anna")},
        "in": {("glass", "cupboard")},
        "on": frozenset(),
        "plugged_into": {("kettle", "socket")},
    },
    attributes={"cupboard": {"open": True}, "mug": {"full": False}, "glass": {"full": False}},
    conditions={"dark": False},
)
SIGHT = Sight(GRAPH, (100, 20), "a picture")
BARE = Lexicon()


@pytest.mark.parametrize(
    ("name", "arguments", "meaning", "truth"),
    [
        ("holding", "anna mug", "The person holds the cup.", True),
        ("holding", "anna glass", "The person holds the cup.", False),
        ("is_held", "mug", "The cup is held in the air.", True),
        ("hand_free", "anna", "The hand of the person is empty.", False),
        ("inside", "glass cupboard", "The first is inside the second.", True),
        ("contains", "cupboard glass", "The cupboard contains the cup.", True),
        ("is_empty", "cupboard", "The cupboard contains nothing.", False),
        ("is_open", "cupboard", "The cupboard is open.", True),
        ("not_open", "cupboard", "", False),
        ("full", "mug", "The cup is full.", False),
        ("not_full", "mug", "The cup is not full.", True),
        ("plugged_into", "kettle socket", "The kettle is plugged into the socket.", True),
        ("unused", "socket", "Nothing is plugged into the socket.", False),
        ("dark", "", "It is dark.", False),
        ("it_is_not_dark", "", "", True),
    ],
)
def test_what_a_reader_reports_is_understood_without_further_words(
    name: str, arguments: str, meaning: str, truth: bool
) -> None:
    things = arguments.split()
    found = BARE.understand(name, [KINDS[thing] for thing in things], meaning, GRAPH)
    assert found is not None
    assert found.concept.truth(SIGHT, found.arranged(things)) is truth


def test_a_bare_name_is_wording_enough() -> None:
    for concept in BARE.concepts(GRAPH.outline):
        wording = concept.wording
        every = itertools.product(dict.fromkeys(KINDS.values()), repeat=concept.arity)
        fitting = [kinds for kinds in every if concept.fits(kinds)]
        for kinds, name, meaning in in_turn(fitting, wording.names, wording.meanings):
            found = BARE.understand(name, kinds, concept.describe(meaning, kinds), GRAPH)
            assert found is not None
            assert found.concept.idea == concept.idea, (name, meaning)


def test_an_attribute_is_no_matter_of_things_in_which_it_is_not_looked_for() -> None:
    assert BARE.understand("is_open", ["person"], "The person is open.", GRAPH) is None
    assert BARE.understand("ripe", ["cup"], "The cup is ripe.", GRAPH) is None


def test_words_of_a_domain_come_first_and_say_which_kinds_are_spoken_of() -> None:
    words = Words.model_validate(
        {
            "relations": {"plugged_into": {"between": [["appliance", "socket"]]}},
            "attributes": {"open": {"names": ["ajar"], "opposite": {"names": ["shut"]}}},
        }
    )
    lexicon = Lexicon([words])
    concepts = {concept.key: concept for concept in lexicon.concepts(GRAPH.outline)}
    assert concepts["open"].wording.names == ("ajar",)
    assert concepts["not open"].wording.names == ("shut",)
    assert concepts["plugged_into"].kinds == {("appliance", "socket")}
    assert not concepts["plugged_into"].fits(("cup", "socket"))
    turned = lexicon.understand("plugged", ["socket", "appliance"], "One plugged into it.", GRAPH)
    assert turned is not None
    assert turned.arranged(("socket", "kettle")) == ("kettle", "socket")


def picture(**truth: bool) -> Picture:
    """Bytes that start like a PNG and say what is the case."""
    head = b"\x89PNG\r\n\x1a\n" + bytes(8) + struct.pack(">II", 100, 20)
    return Picture(head + json.dumps(truth, sort_keys=True).encode())


def read(png: bytes) -> SceneGraph:
    if not png.startswith(b"\x89PNG"):
        raise PictureError("expected a lamp")
    truth = json.loads(png[24:])
    return SceneGraph(
        (Thing("lamp", "lamp", Box(0, 0, 9, 9)), Thing("cable", "cable", Box(20, 0, 29, 9))),
        {"plugged_into": {("cable", "lamp")} if truth["plugged"] else set()},
        {"lamp": {"lit": truth["lit"]}},
        {"dark": truth["dark"]},
    )


LIGHT = Skill("Light", (Parameter("lamp", "lamp"),))
LAMPS = Domain(
    name="lamps",
    agent="A hand.",
    description="A lamp and a cable.",
    types=TypeHierarchy({"lamp": (), "cable": ()}),
    objects=(Object("lamp", ("lamp",)), Object("cable", ("cable",))),
    skills=(LIGHT,),
)


def seen(lit: bool = False, plugged: bool = True, dark: bool = False) -> Observation:
    return Observation((picture(lit=lit, plugged=plugged, dark=dark),))


def assistant(seed: int = 0) -> Assistant:
    return Assistant(ModelSet.of(EmbeddedModel(seed, readers=[read])))


def test_predicates_of_any_world_are_judged() -> None:
    predicates = (
        Predicate("lit", ("lamp",), "The lamp is lit."),
        Predicate("plugged_into", ("cable", "lamp"), "The cable is plugged into the lamp."),
        Predicate("dark", (), "It is dark."),
    )
    question = EvaluationQuestion(LAMPS, LAMPS.objects, seen(lit=True, dark=True), predicates)
    (answer,) = assistant().evaluate([question])
    assert answer.labels == {
        Atom("lit", ("lamp",)): True,
        Atom("plugged_into", ("cable", "lamp")): True,
        Atom("dark", ()): True,
    }


@pytest.mark.parametrize(
    ("difference", "ideas"),
    [
        ({"plugged": False}, {"nothing_plugged_into", "something_plugged_into"}),
        ({"dark": True}, {"it_is_dark", "it_is_not_dark"}),
        ({"lit": True}, {"is_lit", "not_lit"}),
    ],
)
def test_what_tells_two_pictures_apart_is_found(
    difference: dict[str, bool], ideas: set[str]
) -> None:
    instance = SkillInstance("Light", ("lamp",))
    first, second = seen(), seen(**difference)
    question = InventionQuestion(
        LAMPS, LIGHT, InconsistencyKind.PRECONDITION,
        Transition(first, instance, True, first), Transition(second, instance, False, second),
        ("lamp",), (), (), (), 3,
    )  # fmt: skip
    for seed in range(4):
        found = assistant(seed).invent_predicates(question).predicates
        assert {predicate.name for predicate in found} <= ideas
        assert found

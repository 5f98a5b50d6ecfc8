"""The lexicon recognises its own words and those of other people."""

from __future__ import annotations

import itertools

import pytest
from seen_kitchen import LEXICON, kitchen
from turns import in_turn

from skillwrapper.embedded.lexicon import Understanding

GRAPH = kitchen().graph(kitchen().states[0])
TYPES = {"robot": ["robot"], "item": ["pickupable", "cuttable"], "station": ["station"]}


def understand(name: str, kinds: str, semantics: str) -> Understanding | None:
    return LEXICON.understand(name, kinds.split(), semantics, GRAPH)


def test_no_two_concepts_share_a_key_or_a_name() -> None:
    concepts = LEXICON.concepts(GRAPH.outline)
    names = [name for concept in concepts for name in concept.wording.names]
    assert len(set(names)) == len(names)
    assert len({concept.key for concept in concepts}) == len(concepts)


def test_every_wording_of_its_own_is_understood_as_what_it_means() -> None:
    for concept in LEXICON.concepts(GRAPH.outline):
        for kinds in itertools.product(TYPES, repeat=concept.arity):
            if concept.fits(kinds):
                every = list(itertools.product(*(TYPES[kind] for kind in kinds)))
                names, meanings = concept.wording.names, concept.wording.meanings
                for types, name, meaning in in_turn(every, names, meanings):
                    sentence = f"{concept.describe(meaning, types)}."
                    found = LEXICON.understand(name, kinds, sentence, GRAPH)
                    assert found is not None
                    assert (found.concept.key, name, sentence) == (concept.key, name, sentence)
                    assert found.order == tuple(range(len(kinds)))


@pytest.mark.parametrize(
    ("name", "kinds", "meaning", "key"),
    [
        ("hand_empty", "robot", "The agent's hand is empty.", "nothing held"),
        ("hand_empty", "robot", "The robot is not holding any object.", "nothing held"),
        ("handempty", "robot", "", "nothing held"),
        ("free_hand", "robot", "The robot's hand carries no item.", "nothing held"),
        ("holding_something", "robot", "The robot has something in its hand.", "something held"),
        ("is_holding", "robot item", "The agent is holding the object.", "inverse held"),
        ("in_hand", "item robot", "The item is in the hand of the robot.", "held"),
        ("left_holds", "robot item", "It holds the item in its left gripper.", "inverse held"),
        ("is_holding", "item", "The agent is holding the object.", "somewhere held"),
        ("obj_free", "item", "The object has nothing on top.", "nothing on"),
        ("nothing_on", "item", "No other ingredient lies directly on top of it.", "nothing on"),
        ("has_item_on_top", "item", "Some item is on top of it.", "something on"),
        ("station_free", "station", "The station has nothing on top.", "nothing on"),
        ("empty", "station", "The station is empty.", "nothing on"),
        ("station_occupied", "station", "An item is placed on it.", "something on"),
        ("is_on_top", "item item", "The first is on top of the second.", "on"),
        ("stacked", "item item", "The first is held up by contact with the second.", "on"),
        ("supports", "item item", "The second rests on the first.", "inverse on"),
        ("is_under", "item item", "", "inverse on"),
        ("is_on_station", "item station", "The object is on top of the station.", "on"),
        ("contains", "station item", "The station has the item on its surface.", "on"),
        ("is_cut", "item", "The object is cut or sliced.", "cut"),
        ("chopped", "item", "In many pieces rather than one intact piece.", "cut"),
        ("is_whole", "item", "The lettuce is not yet cut.", "not cut"),
        ("is_cooked", "item", "The object is cooked.", "cooked"),
        ("done", "item", "A browned surface or grill marks, not raw or pink.", "cooked"),
        ("is_raw", "item", "The meat is pink.", "not cooked"),
        ("on_cutting_board", "item", "The item is on the cutting board.", "on board"),
        ("on_stove_surface", "item", "The item rests on the stove's surface.", "on stove"),
        ("ontable", "item", "The item is on a table.", "on some table"),
        ("next_to", "robot station", "The robot stands next to the station.", "near"),
        ("left_of", "item item", "The first is to the left of the second.", "left_of"),
    ],
)
def test_other_peoples_words(name: str, kinds: str, meaning: str, key: str) -> None:
    found = understand(name, kinds, meaning)
    assert found is not None
    assert found.concept.key == key


def test_arguments_are_arranged_by_their_kinds() -> None:
    found = understand("in_hand", "item robot", "It is in the robot's hand.")
    assert found is not None
    assert found.concept.key == "inverse held"
    assert found.arranged(("patty", "robot")) == ("robot", "patty")


@pytest.mark.parametrize("words", ["is_happy", "quixotic", ""])
def test_what_is_not_understood_is_not_guessed(words: str) -> None:
    assert understand(words, "item", "It is in a good mood.") is None

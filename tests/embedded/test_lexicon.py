"""The lexicon recognises its own words and those of other people."""

from __future__ import annotations

import itertools

import pytest

from skillwrapper.embedded.lexicon import all_concepts, understand

PLACES = ("stove", "board")
TYPES = {"robot": ["robot"], "item": ["pickupable", "cuttable"], "station": ["station"]}


def test_no_two_concepts_share_a_key_or_a_name() -> None:
    concepts = all_concepts(PLACES)
    names = [name for concept in concepts for name in concept.names]
    assert len(set(names)) == len(names)
    assert len({concept.key for concept in concepts}) == len(concepts)


def test_every_wording_of_its_own_is_understood_as_what_it_means() -> None:
    for concept in all_concepts(PLACES):
        for kinds in itertools.product(TYPES, repeat=len(concept.kinds)):
            if concept.fits(kinds):
                for types in itertools.product(*(TYPES[kind] for kind in kinds)):
                    for name, meaning in itertools.product(concept.names, concept.meanings):
                        sentence = f"{concept.describe(meaning, types)}."
                        found = understand(name, kinds, sentence, PLACES)
                        assert found is not None
                        assert (found.concept.key, name, sentence) == (concept.key, name, sentence)
                        assert found.order == tuple(range(len(kinds)))


@pytest.mark.parametrize(
    ("name", "kinds", "meaning", "key"),
    [
        ("hand_empty", "robot", "The agent's hand is empty.", "hand_empty"),
        ("hand_empty", "robot", "The robot is not holding any object.", "hand_empty"),
        ("handempty", "robot", "", "hand_empty"),
        ("free_hand", "robot", "The robot's hand carries no item.", "hand_empty"),
        ("holding_something", "robot", "The robot has something in its hand.", "hand_full"),
        ("is_holding", "robot item", "The agent is holding the object.", "holding"),
        ("in_hand", "item robot", "The item is in the hand of the robot.", "holding"),
        ("is_holding", "item", "The agent is holding the object.", "is_held"),
        ("obj_free", "item", "The object has nothing on top.", "clear"),
        ("nothing_on", "item", "No other ingredient lies directly on top of it.", "clear"),
        ("has_item_on_top", "item", "Some item is on top of it.", "covered"),
        ("station_free", "station", "The station has nothing on top.", "free"),
        ("empty", "station", "The station is empty.", "free"),
        ("station_occupied", "station", "An item is placed on it.", "occupied"),
        ("is_on_top", "item item", "The first is on top of the second.", "on"),
        ("stacked", "item item", "The first is held up by contact with the second.", "on"),
        ("supports", "item item", "The second rests on the first.", "supports"),
        ("is_under", "item item", "", "supports"),
        ("is_on_station", "item station", "The object is on top of the station.", "on_station"),
        ("contains", "station item", "The station has the item on its surface.", "on_station"),
        ("is_cut", "item", "The object is cut or sliced.", "cut"),
        ("chopped", "item", "In many pieces rather than one intact piece.", "cut"),
        ("is_whole", "item", "The lettuce is not yet cut.", "whole"),
        ("is_cooked", "item", "The object is cooked.", "cooked"),
        ("done", "item", "A browned surface or grill marks, not raw or pink.", "cooked"),
        ("is_raw", "item", "The meat is pink.", "raw"),
        ("on_cutting_board", "item", "The item is on the cutting board.", "on_board"),
        ("on_stove_surface", "item", "The item rests on the stove's surface.", "on_stove"),
        ("ontable", "item", "The item is on a table.", "on_table"),
        ("next_to", "robot station", "The robot stands next to the station.", "near"),
        ("left_of", "item item", "The first is to the left of the second.", "left_of"),
    ],
)
def test_other_peoples_words(name: str, kinds: str, meaning: str, key: str) -> None:
    found = understand(name, tuple(kinds.split()), meaning, PLACES)
    assert found is not None
    assert found.concept.key == key


def test_arguments_are_arranged_by_their_kinds() -> None:
    found = understand("in_hand", ("item", "robot"), "It is in the robot's hand.", PLACES)
    assert found is not None
    assert found.arranged(("patty", "robot")) == ("robot", "patty")


@pytest.mark.parametrize("words", ["is_happy", "quixotic", ""])
def test_what_is_not_understood_is_not_guessed(words: str) -> None:
    assert understand(words, ("item",), "It is in a good mood.", PLACES) is None

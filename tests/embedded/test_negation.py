"""What a sentence denies is not what it says: the lexicon is undecided rather than wrong.

Each sentence is one that a real model might write. Its truth is that of a concept of the lexicon,
or of its opposite (with an exclamation mark); None where no concept means it.
"""

from __future__ import annotations

import itertools
from functools import cache

import pytest
from seen_kitchen import LEXICON, kitchen, sketch_graph

from skillwrapper.embedded.concepts import Concept
from skillwrapper.embedded.scene_graph import SceneGraph
from skillwrapper.embedded.sight import Sight

# name of the predicate | kinds of its parameters | sentence | what it means
CORPUS = """
off_board | item | The item is not on the board. | !on board
far_from_done | item | The item is far from cooked. |
half_done | item | The item is only half cooked. |
hardly_done | item | The item is hardly cooked. |
barely_cut | item | The item is barely cut. |
kept_off | item | The item avoids the stove. |
ungripped | item | The item is held by no robot. |
ungripped | item | The item is held by no one. |
ungripped | item | The item is held by nothing. |
ungripped | item | No robot holds the item. |
handless | item | The item is in no hand. |
homeless | item | The item lies on no station. |
homeless | item | The item rests on nothing. |
to_cook | item | The item is before being cooked. |
to_cut | item | The item is shown before it is cut. |
open_top | item | No item lies on the item. | nothing on
open_top | item | The item has no other thing on it. | nothing on
kept_from | item | Something prevents the item from being held. |
refused | robot item | The robot refuses to hold the item. |
tried | robot item | The robot tries to hold the item. |
failed | robot item | The robot failed to hold the item. |
let_go_of | item | The item is free of the robot's grasp. |
out_of_reach | item | It is impossible that the item is held. |
wanted | robot item | The robot wants to hold the item. |
not_on_board | item | | !on board
on_board | item | The item is not on the cutting board. | !on board
away_from_stove | item | The item is no longer on the stove. | !on stove
off_stove | item | The item isn't on the stove. | !on stove
off_stove | item | The item has never been on the stove. |
not_at_station | item station | The item is not on the station. | !on
removed | item station | The item has been taken off and does not lie on the station. | !on
separate | item item | The first item is not on top of the second. | !on
apart | item item | The first item does not touch or rest on the second. | !on
unstacked | item item | The first item isn't stacked upon the second one. | !on
not_under | item item | The first item is not beneath the second. | !inverse on
lets_go | robot item | The robot does not hold the item. | !inverse held
not_holding | robot item | | !inverse held
not_held | item | Nobody holds the item. | !somewhere held
put_down | item | The item is not being held. | !somewhere held
released | item | The item isn't in the robot's hand. | !somewhere held
not_in_hand | item robot | The item is not in the hand of the robot. | !inverse held
hand_empty | robot | The robot holds nothing. | nothing held
hand_free | robot | The robot is not holding anything. | nothing held
hand_free | robot | The robot's hand does not carry any item. | nothing held
hand_free | robot | No item is held by the robot. | nothing held
hand_busy | robot | The robot's hand is not empty. | something held
hand_busy | robot | The robot's hand is non-empty. | something held
hand_busy | robot | It is not the case that the hand is free. | something held
hand_busy | robot | The robot's hand is never free. |
hand_busy | robot | The robot holds something. | something held
top_clear | item | Nothing lies on the item. | nothing on
top_clear | item | No other item rests on top of it. | nothing on
top_clear | item | The item is not covered. | nothing on
top_clear | item | There isn't anything on top of the item. | nothing on
covered | item | The item is not clear. | something on
covered | item | The top of the item is not free. | something on
covered | item | The item does not have a clear top. | something on
covered | item | Something lies on the item. | something on
station_free | station | Nothing is on the station. | nothing on
station_free | station | The station is not occupied. | nothing on
station_free | station | The station is free of items. | nothing on
station_busy | station | The station is not empty. | something on
station_busy | station | The station is not free. | something on
station_busy | station | The station isn't unoccupied. | something on
station_busy | station | The station is no longer empty. | something on
station_busy | station | An item is on the station. | something on
uncut | item | The item is not cut. | not cut
uncut | item | The item has not been cut yet. | not cut
uncut | item | The item hasn't been sliced into pieces. | not cut
uncut | item | The item is not in pieces. | not cut
uncut | item | The item was never chopped. | not cut
uncut | item | The item is whole. | not cut
uncut | item | No cut was made. | not cut
is_cut | item | The item is not whole. | cut
is_cut | item | The item is no longer whole. | cut
is_cut | item | The item isn't intact any more. | cut
is_cut | item | The item is in pieces, not whole. | cut
is_cut | item | In many pieces rather than one intact piece. | cut
raw | item | The item is not cooked. | not cooked
raw | item | The item has not yet been grilled. | not cooked
raw | item | The item shows no brown color. | not cooked
raw | item | The item is without grill marks, uncooked. | not cooked
raw | item | The item is pink, not brown. | not cooked
cooked | item | The item is not raw. | cooked
cooked | item | The item is no longer pink. | cooked
cooked | item | The item isn't uncooked. | cooked
cooked | item | A browned surface or grill marks, not raw or pink. | cooked
can_be_cut | item | The item can be cut. |
can_cut | item | The item could be sliced. |
must_cook | item | The item must be cooked. |
about_to_cut | item | The item is about to be cut. |
to_be_held | item | The item should be held by the robot. |
was_held | item | The item used to be in the robot's hand. |
ready | item | The item is ready to be put on the stove. |
may_stack | item item | The first item may be placed on the second. |
will_be_on | item station | The item will be on the station. |
not_cut_nor_cooked | item | The item is neither cut nor cooked. |
on_nothing | item | The item is not on any station. |
off_table | item | The item is not on a table. | !on some table
off_table | item | The item has left its table. |
only_held | item | The item is anywhere but in the hand. |
without_board | item | The item lies anywhere except on the board. | !on board
p | item | The item is a long way off the board. | !on board
p | item | Nobody put the item on the stove. | !on stove
p | item | The item is seldom on the board. |
p | item | The item has yet to reach the board. | !on board
p | item | The stove lacks the item. | !on stove
p | item | The item is excluded from the board. | !on board
p | item | The item is separated from the board. | !on board
p | item | The item is apart from the stove. | !on stove
p | item | The item is detached from the stove. | !on stove
p | item | The item is cooked only on one side. |
p | item | The item is less than cooked. |
p | item | The item is still raw, though called cooked. |
p | item | The item is due to be cut. |
p | item | The item is for cutting. |
p | item | The item is a candidate for the stove. |
p | item | The item is above the stove, hanging in the air. |
p | item | The item is under the board. |
p | item | The item is behind the stove. |
p | item | The item is on the other side of the board. |
p | item | The item is incompletely cut. |
p | item | The item is not yet on the stove. | !on stove
p | robot item | The robot lost its hold on the item. |
p | robot item | The robot gave up holding the item. |
p | robot item | The robot put down the item. |
p | robot item | The robot quit holding the item. |
p | robot item | The robot has finished holding the item. |
p | item | The item is on the way to the stove. |
p | item | The item is the opposite of cooked. |
p | item | The item is unlikely to be on the board. |
p | item | There is doubt that the item is on the board. |
p | item | It is untrue that the item is cut. | !cut
p | item | It is wrong to say the item is cut. | !cut
p | item | The item is hypothetically on the stove. |
p | item | The item used to be cooked on the stove. |
p | item | The item is anywhere but on the board. | !on board
p | item | The board is where the item is not. | !on board
p | item | The item lies on the board no more. | !on board
p | item | Of all items, this one alone isn't on the stove. | !on stove
p | item | It is false that the item is on the stove. | !on stove
p | item | It is not the case that the item is on the board. | !on board
p | item | The item is missing from the board. | !on board
p | item | The item has left the board. | !on board
p | item | The item is clear of the stove. | !on stove
p | item | The item is beyond the stove. |
p | item | The item is uncooked. | !cooked
p | item | The item is yet to be cooked. | !cooked
p | item | The item still needs cutting. | !cut
p | item | The item is anything but cooked. | !cooked
p | item | The item is cooked insufficiently. |
p | item | The item remains whole; no cut can be seen. | !cut
p | item | The item is cut-free. | !cut
p | robot item | The robot has dropped the item. |
p | robot item | The robot let go of the item. |
p | robot item | The robot released the item from its grip. |
p | robot item | The robot stopped holding the item. |
p | robot item | The robot holds everything other than the item. |
p | robot item | The robot's hand is void of the item. |
p | robot item | The robot is too far to hold the item. |
p | robot item | The robot ceases to hold the item. |
p | item | Contrary to appearances the item is on no stove. | !on stove
p | item | The item is at best next to the board, certainly not on it. | !on board
p | item | The item is on the board only in imagination. |
p | item | zero contact between item and board. | !on board
p | item | The item is on the stove in the first picture but gone from it now. | !on stove
p | item | The item is exempt from being on the board. |
p | item | The item sits on something that is not the board. | !on board
p | item | The item is on the floor instead of the board. | !on board
p | item | The item is no stranger to the board. |
p | item | If cooked, the item would be brown; it is pale. | !cooked
p | item | The item is expected on the stove. |
p | item | The item is forbidden on the stove. |
p | item | The item ought to lie on the board. |
p | item | The item belongs on the board. |
p | item | Someone took the item from the board. | !on board
p | item | The item is devoid of cuts. | !cut
p | item | The item awaits cooking. | !cooked
p | item | The item is undercooked. |
p | item | The item is insufficiently cooked. |
p | item | The item is on neither station. |
p | robot | The robot's hand is never empty. |
p | item | The item is pre-cut stage. |
"""
ROWS = [tuple(part.strip() for part in row.split("|")) for row in CORPUS.strip().splitlines()]


@cache
def graphs() -> tuple[SceneGraph, ...]:
    return tuple(sketch_graph(state) for state in kitchen().sample(60))


def truths(concept: Concept, order: tuple[int, ...], kinds: tuple[str, ...]) -> list[bool | None]:
    """What a concept says of all things, in all sampled states."""
    found = []
    for graph in graphs():
        sight = Sight(graph, (100, 100), "")
        for names in itertools.product(*(graph.names(kind) for kind in kinds)):
            if len(set(names)) == len(names):
                found.append(concept.truth(sight, tuple(names[i] for i in order)))
    return found


def wanted(key: str, kinds: tuple[str, ...]) -> list[bool | None]:
    concept = next(
        c for c in LEXICON.concepts(graphs()[0].outline) if c.key == key.removeprefix("!")
    )
    order = next(
        o for o in itertools.permutations(range(len(kinds))) if concept.fits([kinds[i] for i in o])
    )
    said = truths(concept, order, kinds)
    return [None if x is None else not x for x in said] if key.startswith("!") else said


def outcome(row: tuple[str, ...]) -> str:
    name, spoken, sentence, key = row
    kinds = tuple(spoken.split())
    found = LEXICON.understand(name, kinds, sentence, graphs()[0])
    if found is None:
        return "undecided"
    if not key:
        return f"wrong: taken for {found.concept.key}"
    right = truths(found.concept, found.order, kinds) == wanted(key, kinds)
    return "right" if right else f"wrong: taken for {found.concept.key}"


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}-{row[2]}")
def test_no_sentence_is_taken_for_another(row: tuple[str, ...]) -> None:
    assert not outcome(row).startswith("wrong")


def test_most_sentences_that_a_concept_means_are_understood() -> None:
    assert len(ROWS) >= 60
    meant = [row for row in ROWS if row[3] and not row[3].startswith("!")]
    understood = [row for row in meant if outcome(row) == "right"]
    assert len(understood) >= 0.6 * len(meant)

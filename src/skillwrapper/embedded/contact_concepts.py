"""Concepts about contact between things and about how a thing looks."""

from __future__ import annotations

import re
from functools import lru_cache

from skillwrapper.embedded.concepts import Concept, Judge
from skillwrapper.embedded.sight import Sight

_NOTHING = (
    r"\bnothing\b|\bno (?!longer)\w+|\bclear\b|\bfree\b|\bunobstructed\b|\buncovered\b"
    r"|\bexposed\b|\bnot (?:covered|occupied)\b|\bempty\b|\bvacant\b|\bunoccupied\b"
)
_SOMETHING = (
    r"\bsomething\b|\banother\b|\bcovered\b|\boccupied\b|\btopped\b|\bin use\b|\bat least one\b"
    r"|\bhas (?:an? |some)"
)


def _hand_is_empty(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return not sight.scene.held_by(arguments[0])


def _holds(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return sight.scene.held.get(arguments[1]) == arguments[0]


def _is_held(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return sight.scene.is_held(arguments[0])


def _is_on(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return sight.scene.is_on(arguments[0], arguments[1])


def _carries(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return sight.scene.is_on(arguments[1], arguments[0])


def _is_clear(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return sight.scene.is_clear(arguments[0])


def _lies_on(kind: str) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.scene.kind(sight.scene.on.get(arguments[0], "")) == kind

    return judge


def _has(attribute: str) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.scene.has(arguments[0], attribute)

    return judge


def _is_in_stack(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return _stands_on_item(sight, arguments[0]) or not sight.scene.is_clear(arguments[0])


def _is_stack_bottom(sight: Sight, arguments: tuple[str, ...]) -> bool:
    on_item = _stands_on_item(sight, arguments[0])
    return not on_item and not sight.scene.is_clear(arguments[0])


def _is_stack_top(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return _stands_on_item(sight, arguments[0]) and sight.scene.is_clear(arguments[0])


def _stands_on_item(sight: Sight, name: str) -> bool:
    return sight.scene.kind(sight.scene.on.get(name, "")) == "item"


HAND_CONCEPTS = (
    Concept(
        "hand_empty", ("robot",), "hand_empty", _hand_is_empty,
        ("hand_empty", "gripper_free", "empty_handed", "hand_is_free", "holds_nothing"),
        ("the hand of the {0} is empty", "the {0} holds nothing",
         "nothing is in the gripper of the {0}"),
        r"empty\b|\bfree\b|\bvacant\b|hold(?:s|ing)? (?:nothing|no\b)|carr(?:ies|ying) no"
        r"|\bnot?\b.{0,25}(?:hold|carr|grasp|grip)|n't.{0,25}(?:hold|carr|grasp|grip)"
        r"|(?:nothing|no \w+(?: \w+)?) is (?:in|held|grasped|carried)",
        salience=3, local=True,
    ),
    Concept(
        "hand_full", ("robot",), "hand_empty", _hand_is_empty,
        ("hand_full", "holding_something", "gripper_occupied", "hand_busy"),
        ("the {0} holds something", "something is in the hand of the {0}"),
        r"(?:hold|carr|grasp|grip)\w* (?:something|an? |any|one|some)|\bfull\b|\boccupied\b"
        r"|\bbusy\b|something is (?:in|held)|\bclosed around\b",
        local=True, positive=False,
    ),
    Concept(
        "holding", ("robot", "item"), "holding", _holds,
        ("holding", "holds", "grasping", "carrying", "has_in_hand"),
        ("the {0} holds the {1} in its hand", "the {1} is in the gripper of the {0}",
         "the {0} carries the {1}"),
        r"\bhold|\bheld\b|\bgrasp|\bcarr(?:y|ies)|\bgrip|in (?:the|its|his) \w*\s?hand|in hand",
        salience=3, local=True,
    ),
    Concept(
        "is_held", ("item",), "is_held", _is_held,
        ("is_held", "in_hand", "lifted", "picked_up"),
        ("the robot holds the {0}", "the {0} is in the hand of the robot",
         "the {0} is held in the air"),
        r"\bheld\b|\bholds\b|\bholding\b|in .{0,20}(?:hand|gripper)|\blifted\b|\bpicked\b"
        r"|\bin hand",
        salience=1, local=True,
    ),
)  # fmt: skip

PLACE_CONCEPTS = (
    Concept(
        "supports", ("item", "item"), "on", _carries,
        ("supports", "directly_under", "beneath", "carries_on_top"),
        ("the {1} lies directly on the {0}", "the {0} is directly under the {1} and touches it"),
        r"\bunder\b|\bunderneath\b|\bbeneath\b|\bbelow\b|\bsupports\b|\bcarries\b"
        r"|\bsecond\b[^.]*\b(?:on|upon|atop|by)\b[^.]*\bfirst\b",
        salience=0.5, local=True,
    ),
    Concept(
        "on", ("item", "item"), "on", _is_on,
        ("on_top_of", "stacked_on", "directly_on", "rests_on", "placed_on_top_of"),
        ("the {0} lies directly on the {1}", "the {0} rests on top of the {1} and touches it",
         "the {0} is stacked right on the {1} with nothing in between"),
        r"\bon\b|\bonto\b|\bstacked\b|\batop\b|\bupon\b|\bsupported by\b|\brest(?:s|ing)\b",
        salience=3, local=True,
    ),
    Concept(
        "on_station", ("item", "station"), "on_station", _is_on,
        ("on_station", "placed_at", "resting_at", "lies_at", "sits_on_surface"),
        ("the {0} lies directly on the {1}", "the {0} rests on the surface of the {1}",
         "the {0} is in contact with the top of the {1}"),
        r"\bon\b|\bat\b|\bonto\b|\brest(?:s|ing)\b|\bplaced\b|\bsits\b|\bcontact\b|\blies\b",
        salience=3, local=True,
    ),
    Concept(
        "free", ("station",), "free", _is_clear,
        ("station_free", "surface_empty", "station_clear", "unoccupied"),
        ("nothing lies on the {0}", "the surface of the {0} is empty",
         "no object rests on the {0}"),
        _NOTHING,
        salience=3, local=True,
    ),
    Concept(
        "occupied", ("station",), "free", _is_clear,
        ("occupied", "station_in_use", "surface_taken"),
        ("something lies on the {0}", "at least one object rests on the {0}"),
        _SOMETHING + r"|\bis (?:placed|resting|lying) on\b",
        local=True, positive=False,
    ),
    Concept(
        "on_table", ("item",), "on_table", _lies_on("table"),
        ("on_table", "lies_on_table", "still_on_table"),
        ("the {0} lies directly on a table", "the {0} rests on the top of a table"),
        r"\btables?\b",
        salience=1, local=True,
    ),
    Concept(
        "on_some_station", ("item",), "on_some_station", _lies_on("station"),
        ("on_some_station", "at_work_place"),
        ("the {0} lies directly on one of the stations",),
        r"\bstations?\b|\bwork place\b",
        salience=0.5, local=True,
    ),
)  # fmt: skip

STACK_CONCEPTS = (
    Concept(
        "stack_bottom", ("item",), "stack_bottom", _is_stack_bottom,
        ("at_stack_bottom", "lowest_of_stack"),
        ("the {0} is the lowest thing of a stack of at least two",),
        r"\blowest\b|\bbottom of\b|\bbase of\b|stack bottom",
        salience=0.3, local=True,
    ),
    Concept(
        "stack_top", ("item",), "stack_top", _is_stack_top,
        ("at_stack_top", "highest_of_stack"),
        ("the {0} is the highest thing of a stack of at least two",),
        r"\bhighest\b|\btop of a (?:stack|pile)\b|stack top|\btopmost\b",
        salience=0.3, local=True,
    ),
    Concept(
        "in_stack", ("item",), "in_stack", _is_in_stack,
        ("in_stack", "part_of_stack"),
        ("the {0} is part of a stack of at least two things",),
        r"\bpart of\b|\bin (?:a |the )?(?:stack|pile)\b|\bis stacked\b",
        salience=0.5, local=True,
    ),
    Concept(
        "clear", ("item",), "clear", _is_clear,
        ("top_clear", "nothing_on_top", "uncovered", "top_is_free"),
        ("nothing lies on the {0}", "no other thing rests on top of the {0}",
         "the top of the {0} is free"),
        _NOTHING,
        salience=3, local=True,
    ),
    Concept(
        "covered", ("item",), "clear", _is_clear,
        ("covered", "has_something_on_top", "topped"),
        ("something lies on the {0}", "another thing rests on top of the {0}"),
        _SOMETHING + r"|\bon top of (?:it|the)\b",
        local=True, positive=False,
    ),
)  # fmt: skip

LOOK_CONCEPTS = (
    Concept(
        "whole", ("item",), "cut", _has("cut"),
        ("whole", "uncut", "intact", "in_one_piece"),
        ("the {0} is whole", "the {0} is in one piece"),
        r"\bwhole\b|\buncut\b|\bintact\b|\bone piece\b|\bunsliced\b"
        r"|\bnot (?:yet )?(?:been )?(?:cut|chopped|sliced)\b",
        local=True, positive=False,
    ),
    Concept(
        "cut", ("item",), "cut", _has("cut"),
        ("is_cut", "chopped", "sliced", "in_pieces", "shredded"),
        ("the {0} has been cut into pieces", "the {0} consists of many small pieces",
         "the {0} is shredded"),
        r"\bcut\b|\bchopped\b|\bsliced\b|\bdiced\b|\bshred|\bpieces\b|\bslices\b|\bcut up\b",
        salience=3, local=True,
    ),
    Concept(
        "raw", ("item",), "cooked", _has("cooked"),
        ("raw", "uncooked", "looks_pink"),
        ("the {0} is raw", "the {0} looks pink and uncooked"),
        r"\braw\b|\buncooked\b|\bpink\b|\bnot (?:yet )?(?:been )?(?:cooked|grilled|fried|done)\b",
        local=True, positive=False,
    ),
    Concept(
        "cooked", ("item",), "cooked", _has("cooked"),
        ("is_cooked", "grilled", "browned", "fried"),
        ("the {0} has been cooked", "the {0} is brown and grilled",
         "the {0} looks dark brown, with grill marks"),
        r"\bcooked\b|\bgrill(?:ed)?\b|\bbrown(?:ed)?\b|\bfried\b|\bseared\b|\bdone\b",
        salience=3, local=True,
    ),
)  # fmt: skip


@lru_cache(maxsize=256)
def on_named_place(name: str) -> Concept:
    """The concept of lying directly on one certain station."""

    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.scene.is_on(arguments[0], name)

    words = r"[\s_-]?".join(map(re.escape, re.split(r"[\s_-]+", name)))
    return Concept(
        f"on_{name}", ("item",), f"on_{name}", judge,
        (f"on_{name}", f"on_{name}_surface", f"lies_on_{name}"),
        (f"the {{0}} lies directly on the {name}", f"the {{0}} rests on the surface of the {name}"),
        words,
        salience=1, local=True,
    )  # fmt: skip

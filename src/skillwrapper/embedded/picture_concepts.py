"""Concepts about where in the picture a thing is seen: easy to see, seldom of any use."""

from __future__ import annotations

from skillwrapper.embedded.concepts import Concept, Judge
from skillwrapper.embedded.facts import Fact, Sort
from skillwrapper.embedded.sight import Sight
from skillwrapper.embedded.words import Wording


def _at_place(place: str) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(Fact(Sort.PLACE, place, arguments))

    return judge


def _place(
    key: str, arity: int, names: tuple[str, ...], meanings: tuple[str, ...], *cues: str,
    opposite_of: str = "", salience: float = 1.0,
) -> Concept:  # fmt: skip
    place = opposite_of or key
    return Concept(
        key=key,
        idea=place,
        arity=arity,
        judge=_at_place(place),
        wording=Wording(names=names, meanings=meanings, cues=cues, salience=salience),
        local=False,
        positive=not opposite_of,
    )


PICTURE_CONCEPTS = (
    _place(
        "left_of", 2, ("left_of", "further_left_than"),
        ("the {0} is left of the {1} in the picture",
         "in the picture the {0} is further left than the {1}"),
        r"left(?!\W+(?:hand|arm|gripper|claw)s?\b)",
    ),
    _place(
        "right_of", 2, ("right_of", "further_right_than"),
        ("the {0} is right of the {1} in the picture",
         "in the picture the {0} is further right than the {1}"),
        "right of", "further right", "to the right", "right side",
        opposite_of="left_of",
    ),
    _place(
        "higher", 2, ("higher_in_picture", "further_up_than"),
        ("the {0} is higher in the picture than the {1}",
         "in the picture the {0} is further up than the {1}"),
        "higher in (?:the )?picture", "further up", "upper part", "higher than",
    ),
    _place(
        "lower", 2, ("lower_in_picture", "further_down_than"),
        ("the {0} is lower in the picture than the {1}",
         "in the picture the {0} is further down than the {1}"),
        "lower in (?:the )?picture", "further down", "lower than",
        opposite_of="higher",
    ),
    _place(
        "near", 2, ("near", "close_to", "next_to"),
        ("the {0} is near the {1}", "the {0} is close to the {1}", "the {0} is next to the {1}"),
        "near", "close to", "next to", "beside", "adjacent", "proximity", "nearby",
        salience=2,
    ),
    _place(
        "far", 2, ("far_from", "apart_from"),
        ("the {0} is far from the {1}", "there is much room between the {0} and the {1}"),
        "far (?:from|away)", "much room between", "apart", "distant",
    ),
    _place(
        "same_row", 2, ("same_row_as", "level_with"),
        ("the {0} and the {1} are at the same height of the picture",),
        "same (?:row|height|level)", "level with",
    ),
    _place(
        "same_column", 2, ("same_column_as", "in_line_with"),
        ("the {0} and the {1} are in one vertical line of the picture",),
        "same column", "vertical line", "in line with",
    ),
    _place(
        "larger", 2, ("looks_larger_than", "bigger_than"),
        ("the {0} looks larger than the {1}",
         "the {0} takes more room in the picture than the {1}"),
        "larger", "bigger", "more room in",
    ),
    _place(
        "left_half", 1, ("in_left_half", "on_left_side"),
        ("the {0} is in the left half of the picture",),
        "left (?:half|side)",
    ),
    _place(
        "right_half", 1, ("in_right_half", "on_right_side"),
        ("the {0} is in the right half of the picture",),
        "right (?:half|side)",
        opposite_of="left_half",
    ),
    _place(
        "upper_half", 1, ("in_upper_half", "in_upper_part"),
        ("the {0} is in the upper half of the picture",),
        "upper (?:half|part|side)", "top half",
    ),
    _place(
        "lower_half", 1, ("in_lower_half", "in_lower_part"),
        ("the {0} is in the lower half of the picture",),
        "lower (?:half|part|side)", "bottom half",
        opposite_of="upper_half",
    ),
    _place(
        "central", 1, ("in_the_middle", "near_centre"),
        ("the {0} is near the middle of the picture",),
        "middle", "cent(?:re|er|ral)",
    ),
    _place(
        "at_edge", 1, ("at_picture_edge", "near_border"),
        ("the {0} is close to the edge of the picture",),
        "edge", "border", "margin",
    ),
    _place(
        "wide", 1, ("wider_than_tall", "looks_flat"),
        ("the {0} looks wider than it is tall",),
        "wider than", "looks flat", "flat",
    ),
)  # fmt: skip

"""Concepts about where in the picture a thing is seen: easy to see, seldom of any use."""

from __future__ import annotations

import math
from collections.abc import Callable

from skillwrapper.embedded.concepts import ANY, Concept, Judge
from skillwrapper.embedded.scene import Box
from skillwrapper.embedded.sight import Sight

_NEAR = 0.22
_SAME_LINE = 0.05
_EDGE = 0.12


def _of_box(test: Callable[[Box, Sight], bool]) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return test(sight.scene.thing_by_name[arguments[0]].box, sight)

    return judge


def _of_boxes(test: Callable[[Box, Box, Sight], bool]) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        first, second = (sight.scene.thing_by_name[name].box for name in arguments)
        return test(first, second, sight)

    return judge


def _distance(first: Box, second: Box, sight: Sight) -> float:
    """Between the middles, as a share of the width of the picture."""
    return math.dist(first.centre, second.centre) / sight.width


def _offset(first: float, second: float, size: int) -> float:
    return abs(first - second) / size


def _above_in_stack(sight: Sight, arguments: tuple[str, ...]) -> bool:
    return sight.scene.is_above(arguments[0], arguments[1])


_LEFT = _of_boxes(lambda a, b, sight: a.centre[0] < b.centre[0])
_HIGHER = _of_boxes(lambda a, b, sight: a.centre[1] < b.centre[1])
_NEARBY = _of_boxes(lambda a, b, sight: _distance(a, b, sight) < _NEAR)
_ROW = _of_boxes(lambda a, b, sight: _offset(a.centre[1], b.centre[1], sight.height) < _SAME_LINE)
_COLUMN = _of_boxes(lambda a, b, sight: _offset(a.centre[0], b.centre[0], sight.width) < _SAME_LINE)
_LARGER = _of_boxes(lambda a, b, sight: a.width * a.height > b.width * b.height)
_LEFT_HALF = _of_box(lambda a, sight: a.centre[0] < sight.width / 2)
_UPPER_HALF = _of_box(lambda a, sight: a.centre[1] < sight.height / 2)
_CENTRAL = _of_box(
    lambda a, sight: math.dist(a.centre, (sight.width / 2, sight.height / 2)) < sight.width / 4
)
_AT_EDGE = _of_box(
    lambda a, sight: (
        min(a.centre[0], sight.width - a.centre[0]) < _EDGE * sight.width
        or min(a.centre[1], sight.height - a.centre[1]) < _EDGE * sight.height
    )
)
_WIDE = _of_box(lambda a, sight: a.width > a.height)

_PAIR = (ANY, ANY)

PICTURE_CONCEPTS = (
    Concept(
        "left_of", _PAIR, "left_of", _LEFT,
        ("left_of", "further_left_than"),
        ("the {0} is left of the {1} in the picture",
         "in the picture the {0} is further left than the {1}"),
        r"\bleft\b",
    ),
    Concept(
        "right_of", _PAIR, "left_of", _LEFT,
        ("right_of", "further_right_than"),
        ("the {0} is right of the {1} in the picture",
         "in the picture the {0} is further right than the {1}"),
        r"\bright of\b|\bfurther right\b|\bto the right\b|right side",
        positive=False,
    ),
    Concept(
        "higher", _PAIR, "higher", _HIGHER,
        ("higher_in_picture", "further_up_than"),
        ("the {0} is higher in the picture than the {1}",
         "in the picture the {0} is further up than the {1}"),
        r"\bhigher in (?:the )?picture\b|\bfurther up\b|\bupper part\b|\bhigher than\b",
    ),
    Concept(
        "lower", _PAIR, "higher", _HIGHER,
        ("lower_in_picture", "further_down_than"),
        ("the {0} is lower in the picture than the {1}",
         "in the picture the {0} is further down than the {1}"),
        r"\blower in (?:the )?picture\b|\bfurther down\b|\blower than\b",
        positive=False,
    ),
    Concept(
        "near", _PAIR, "near", _NEARBY,
        ("near", "close_to", "next_to"),
        ("the {0} is near the {1}", "the {0} is close to the {1}", "the {0} is next to the {1}"),
        r"\bnear\b|\bclose to\b|\bnext to\b|\bbeside\b|\badjacent\b|\bproximity\b|\bnearby\b",
        salience=2,
    ),
    Concept(
        "far", _PAIR, "near", _NEARBY,
        ("far_from", "apart_from"),
        ("the {0} is far from the {1}", "there is much room between the {0} and the {1}"),
        r"\bfar (?:from|away)\b|\bmuch room between\b|\bapart\b|\bdistant\b",
        positive=False,
    ),
    Concept(
        "same_row", _PAIR, "same_row", _ROW,
        ("same_row_as", "level_with"),
        ("the {0} and the {1} are at the same height of the picture",),
        r"\bsame (?:row|height|level)\b|\blevel with\b",
    ),
    Concept(
        "same_column", _PAIR, "same_column", _COLUMN,
        ("same_column_as", "in_line_with"),
        ("the {0} and the {1} are in one vertical line of the picture",),
        r"\bsame column\b|\bvertical line\b|\bin line with\b",
    ),
    Concept(
        "larger", _PAIR, "larger", _LARGER,
        ("looks_larger_than", "bigger_than"),
        ("the {0} looks larger than the {1}",
         "the {0} takes more room in the picture than the {1}"),
        r"\blarger\b|\bbigger\b|\bmore room in\b",
    ),
    Concept(
        "above_in_stack", ("item", "item"), "above_in_stack", _above_in_stack,
        ("above_in_stack", "somewhere_above"),
        ("the {0} is somewhere above the {1} in the same stack",),
        r"\bsomewhere (?:above|on)\b|\bsame stack\b|\babove in stack\b|\bdirectly or\b",
    ),
    Concept(
        "left_half", (ANY,), "left_half", _LEFT_HALF,
        ("in_left_half", "on_left_side"),
        ("the {0} is in the left half of the picture",),
        r"\bleft (?:half|side)\b",
    ),
    Concept(
        "right_half", (ANY,), "left_half", _LEFT_HALF,
        ("in_right_half", "on_right_side"),
        ("the {0} is in the right half of the picture",),
        r"\bright (?:half|side)\b",
        positive=False,
    ),
    Concept(
        "upper_half", (ANY,), "upper_half", _UPPER_HALF,
        ("in_upper_half", "in_upper_part"),
        ("the {0} is in the upper half of the picture",),
        r"\bupper (?:half|part|side)\b|\btop half\b",
    ),
    Concept(
        "lower_half", (ANY,), "upper_half", _UPPER_HALF,
        ("in_lower_half", "in_lower_part"),
        ("the {0} is in the lower half of the picture",),
        r"\blower (?:half|part|side)\b|\bbottom half\b",
        positive=False,
    ),
    Concept(
        "central", (ANY,), "central", _CENTRAL,
        ("in_the_middle", "near_centre"),
        ("the {0} is near the middle of the picture",),
        r"\bmiddle\b|\bcent(?:re|er|ral)\b",
    ),
    Concept(
        "at_edge", (ANY,), "at_edge", _AT_EDGE,
        ("at_picture_edge", "near_border"),
        ("the {0} is close to the edge of the picture",),
        r"\bedge\b|\bborder\b|\bmargin\b",
    ),
    Concept(
        "wide", (ANY,), "wide", _WIDE,
        ("wider_than_tall", "looks_flat"),
        ("the {0} looks wider than it is tall",),
        r"\bwider than\b|\blooks flat\b|\bflat\b",
    ),
)  # fmt: skip

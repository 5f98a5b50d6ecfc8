"""Reading takes time in proportion to a reply's length, counted by work and not by the clock.

Two halves: no pattern can go back and try again without bound, which is read off the patterns; and
the steps of our own code at most double when a reply does.
"""

from __future__ import annotations

import importlib
import pkgutil
import re
import sys
from collections.abc import Iterator
from types import FrameType
from typing import Any

import pytest

import skillwrapper.vlm.parsing
from skillwrapper.symbols import Predicate, all_groundings
from skillwrapper.vlm import answers
from skillwrapper.vlm.parsing import (
    ParameterNames,
    parse_labels,
    parse_plan,
    parse_predicates,
    parse_sequences,
)
from skillwrapper.vlm.parsing.lines import LONGEST_REPLY, reply_lines
from skillwrapper.world import Domain

SIZE = 500
NAMES = ParameterNames({"robot": 1, "pickupable": 2})
UNITS = [
    " ", "\n", "\t \n", "true ", "true\n", "(", ")", "a(", "a(b)", "a (", "((a)", "[", "]", "{",
    "}", '{"a":', "[[", '["a",', "<", "<think>", "</think>", "<thin", "&lt;", "```", "```\n",
    "~~", "~~a", "-", "- ", "- - ", "1. ", "1.", "#", "# ", "|", "| a ", "|---|\n", ",", ", ,",
    ";", ":", "::", "=", "*", "**", "`", "\\", "\\n", "'", '"', "'a", "?", "?a ", "?a - b ", "x",
    "x ", "ab_", "a-", "a.b ", "not ", "no ", "is ", "the ", "or ", "true or ", "true/", "true, ",
    "false: ", "if ", "[x] ", "[ ]", "✓", "“", "\uff08", "\uff0c", "①", "\x1b", "\x1b[", "\x1b]",
    "\ud800", "\u200b", "\r", "é", "9", "0 ", "1\n", "holding(robot, patty)\n",
    "holding(robot, patty) ", "holding(robot, patty): true\n", "holding(robot, patty)\ntrue\n",
    "true:\nholding(robot, patty)\n", "hodling(robto, ptaty) ", "Name: a\n",
    "Statement: a\nReason: b\n", "Pick\n", "Pick -> ", "Pick(robot, patty) -> ", "Sequence 1:\n",
    "Final answer:\n", "<|channel|>", "assistantfinal", "final ", "a b c (", "the the ",
    "step 1 ", "step ", "<s>", "<li>", "predicate ", "new new ", "means ", "a: b\n",
]  # fmt: skip


def patterns() -> Iterator[tuple[str, re.Pattern[str]]]:
    """Every pattern that a reply meets."""
    package = skillwrapper.vlm.parsing
    names = [f"{package.__name__}.{m.name}" for m in pkgutil.iter_modules(package.__path__)]
    for module in (answers, *map(importlib.import_module, names)):
        for name, value in vars(module).items():
            if isinstance(value, re.Pattern):
                yield f"{module.__name__}.{name}", value


def endless_repeats(tree: Any, inside: bool = False) -> Iterator[str]:
    """The repeats in a pattern that can take a number of steps that nothing bounds."""
    constants = sys.modules["re._constants"]
    for operation, argument in tree:
        name = str(operation)
        if name in {"MAX_REPEAT", "MIN_REPEAT", "POSSESSIVE_REPEAT"}:
            endless = argument[1] is constants.MAXREPEAT  # type: ignore[attr-defined]
            if endless and (name != "POSSESSIVE_REPEAT" or inside):
                yield name
            yield from endless_repeats(argument[2], inside or endless)
        elif isinstance(argument, tuple | list):
            for part in _parts(argument):
                yield from endless_repeats(part, inside)


def _parts(argument: Any) -> Iterator[Any]:
    for part in argument:
        if type(part).__name__ == "SubPattern":
            yield part
        elif isinstance(part, list | tuple):
            yield from _parts(part)


@pytest.mark.parametrize(("name", "pattern"), [pytest.param(*p, id=p[0]) for p in patterns()])
def test_no_pattern_goes_back_without_bound(name: str, pattern: re.Pattern[str]) -> None:
    tree = sys.modules["re._parser"].parse(pattern.pattern, pattern.flags)  # type: ignore[attr-defined]
    assert list(endless_repeats(tree)) == [], f"{name}: bound the repeat or make it possessive"


@pytest.mark.parametrize(
    ("pattern", "endless"),
    [
        (r"a*", 1),
        (r"(?:a+)+", 2),
        (r"(?:a*+b)*+", 1),
        (r"a*+", 0),
        (r"a{0,9}?b", 0),
        (r"(a|b+)", 1),
    ],
)
def test_the_check_itself_finds_endless_repeats(pattern: str, endless: int) -> None:
    tree = sys.modules["re._parser"].parse(pattern)  # type: ignore[attr-defined]
    assert len(list(endless_repeats(tree))) == endless


def steps(reply: str, domain: Domain) -> int:
    """Lines of our code that reading a reply in all four ways runs through."""
    vocabulary = [Predicate("holding", ("robot", "pickupable")), Predicate("is_cut", ("cuttable",))]
    atoms = all_groundings(vocabulary, domain.objects)
    count = 0

    def trace(frame: FrameType, event: str, _: object) -> Any:
        nonlocal count
        if "vlm" not in frame.f_code.co_filename:
            return None
        count += event == "line"
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        parse_labels(reply, atoms)
        parse_predicates(reply, NAMES)
        parse_sequences(reply, domain.skills, domain.objects)
        parse_plan(reply, domain.skills, domain.objects)
    finally:
        sys.settrace(before)
    return count


@pytest.mark.parametrize("unit", UNITS, ids=repr)
@pytest.mark.parametrize("end", ["", "x"], ids=repr)
def test_twice_the_reply_takes_twice_the_steps(unit: str, end: str, burger: Domain) -> None:
    replies = [unit * (size // len(unit)) + end for size in (SIZE, 2 * SIZE)]
    steps(replies[1], burger)  # so that lines which come again are known in both
    once, twice = (steps(reply, burger) for reply in replies)
    assert twice <= 2.2 * once + 200


@pytest.mark.parametrize("unit", UNITS, ids=repr)
def test_what_lies_beyond_any_sensible_length_takes_no_steps(unit: str) -> None:
    lengths = (LONGEST_REPLY, 3 * LONGEST_REPLY)
    read = [reply_lines(unit * (length // len(unit))) for length in lengths]
    assert sum(len(line.whole) for line in read[1]) <= LONGEST_REPLY

"""What one line of a summary says by itself: of which groundings, and what of each."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.symbols.predicates import Atom
from skillwrapper.vlm.parsing.calls import Call, find_calls
from skillwrapper.vlm.parsing.markup import Line
from skillwrapper.vlm.parsing.names import NameIndex, fold
from skillwrapper.vlm.parsing.verdicts import (
    Reading,
    Said,
    Verdict,
    ends_sentence,
    is_inference,
    is_link,
    is_nothing_but_verdict,
    is_supposed,
    is_verdict,
    said_alone,
    said_as_heading,
    said_behind,
    said_in_front,
)

_NULLARY = re.compile(r"[\"'(]{0,3}([A-Za-z][\w-]*+)[\"')]{0,3} ?(?=[:=|?]|-|$|is )")
_INTRODUCTION = re.compile(r"[\"'(|]{0,4}(?:[A-Za-z ]{1,20}#? ?\d{0,3} ?[:.)-] ?)?[\"'(|]{0,4}")


@dataclass(frozen=True)
class Statement:
    """A grounding in a line, with what the line says of it.

    Attributes:
        asked: which of the groundings asked for is meant, as a number; None if it is none of them
            or cannot be told.
        call: as written.
        said: what stands around it.
    """

    asked: int | None
    call: Call
    said: Reading


@dataclass(frozen=True)
class LineReading:
    """A line of a summary, understood by itself.

    Attributes:
        text: the line.
        statements: the groundings in it.
        leads: whether it begins with one, rather than mentioning them.
        verdict: what it says if it holds no grounding: of one above or below it.
        is_heading: whether the verdict is marked as the heading of what is below.
        is_pure: whether the line holds nothing but the verdict.
        is_bold: whether the line begins in bold.
        ends_group: whether it is the heading of something else.
    """

    text: str
    statements: tuple[Statement, ...] = ()
    leads: bool = False
    verdict: Verdict | None = None
    is_heading: bool = False
    is_pure: bool = False
    is_bold: bool = False
    ends_group: bool = False

    @cached_property
    def is_open(self) -> bool:
        """Whether it begins with a statement of which it says nothing."""
        return self.leads and any(s.said is Said.NOTHING for s in self.statements)

    @cached_property
    def given(self) -> tuple[Verdict, ...]:
        """The verdicts that it gives on its statements."""
        return tuple(s.said for s in self.statements if isinstance(s.said, Verdict))

    @cached_property
    def is_prose(self) -> bool:
        """Whether it holds neither a statement nor a verdict."""
        return not self.statements and self.verdict is None

    @cached_property
    def mentions(self) -> bool:
        """Whether it speaks of statements further on, and says something of each."""
        said = [statement.said for statement in self.statements]
        return bool(said) and not self.leads and Said.NOTHING not in said


class StatementReader:
    """Understands lines about certain groundings.

    Args:
        atoms: the groundings that were asked for.
    """

    def __init__(self, atoms: Sequence[Atom]) -> None:
        self._predicate_names = frozenset(fold(a.predicate) for a in atoms)
        self._nullary = frozenset(fold(a.predicate) for a in atoms if not a.terms)
        self._exact = {(a.predicate, a.terms): number for number, a in enumerate(atoms)}
        self._predicates = NameIndex(a.predicate for a in atoms)
        self._objects = NameIndex(term for a in atoms for term in a.terms)

    def read(self, line: Line) -> LineReading:
        """What a line says."""
        calls = [call for call in find_calls(line.text) if self._is_statement(call)]
        calls = calls or self._written_bare(line.text)
        if not calls:
            return _without_statement(line)
        said = _said_of_each(line.text, calls)
        statements = (Statement(self._find(c), c, s) for c, s in zip(calls, said, strict=True))
        leads = _INTRODUCTION.fullmatch(line.text[: calls[0].start]) is not None
        return LineReading(line.text, tuple(statements), leads=leads)

    def _is_statement(self, call: Call) -> bool:
        """``true(ly)`` and ``the robot (violet)`` are none; ``holds(robot, cup)`` may be one."""
        known = fold(call.name) in self._predicate_names
        return known or (call.tight and not is_verdict(call.name))

    def _written_bare(self, text: str) -> list[Call]:
        """A grounding without arguments may come without parentheses."""
        found = _NULLARY.match(text) if self._nullary else None
        if found is None or fold(found.group(1)) not in self._nullary:
            return []
        return [Call(found.group(1), (), found.start(1), found.end(1))]

    def _find(self, call: Call) -> int | None:
        exact = self._exact.get((call.name, call.arguments))
        if exact is not None:
            return exact
        predicate = self._predicates.find(call.name)
        terms = [self._objects.find_among(readings) for readings in call.readings]
        known = tuple(term for term in terms if term is not None)
        if predicate is None or len(known) < len(call.arguments):
            return None
        return self._exact.get((predicate, known))  # in another order it is another statement


def _without_statement(line: Line) -> LineReading:
    heading = said_as_heading(line.text, titled=line.titled)
    if isinstance(heading, Verdict):
        return LineReading(line.text, verdict=heading, is_heading=True)
    alone = said_alone(line.text)
    if isinstance(alone, Verdict):
        pure = is_nothing_but_verdict(line.text)
        return LineReading(line.text, verdict=alone, is_pure=pure, is_bold=line.bold)
    return LineReading(line.text, ends_group=line.titled or line.text.endswith(":"))


def _said_of_each(text: str, calls: Sequence[Call]) -> list[Reading]:
    """What a line says of each statement in it."""
    ends = [0, *(call.end for call in calls)]
    starts = [*(call.start for call in calls), len(text)]
    gaps = [text[end:start] for end, start in zip(ends, starts, strict=True)]
    if len(calls) == 1:
        return [_said_of_one(*gaps)]
    fronts = [said_in_front(gap) for gap in gaps[:-1]]
    behinds = [said_behind(gap) for gap in gaps[1:]]
    linked = [is_link(gap) or is_inference(gap) for gap in gaps]
    first_in_front = fronts[0][0] is not Said.NOTHING
    last_behind = behinds[-1] is not Said.NOTHING
    if first_in_front and last_behind:
        return [Said.AMBIGUOUS] * len(calls)
    said: list[Reading] = []
    supposed = False  # if S is true, T is false: neither is claimed
    for number, ((front, negated), behind) in enumerate(zip(fronts, behinds, strict=True)):
        supposed = is_supposed(gaps[number]) or (supposed and not ends_sentence(gaps[number]))
        if linked[number] or linked[number + 1] or supposed:
            said.append(Said.AMBIGUOUS)
        elif first_in_front:  # true: a(), b(), false: c()
            said.append(_joined(said[-1] if front is Said.NOTHING else front, negated))
        elif last_behind or _belongs_to_left(gaps[number + 1]):
            said.append(_joined(behind, negated))
        else:
            said.append(Said.NOTHING if behind is Said.NOTHING else Said.AMBIGUOUS)
    return said


def _said_of_one(before: str, after: str) -> Reading:
    """What stands around the only statement of a line."""
    if is_supposed(before):
        return Said.NOTHING
    front, negated = said_in_front(before)
    asked = after.lstrip("\"' ")
    if asked.startswith("?"):
        front, after = Said.NOTHING, asked[1:]
    behind = said_behind(after)
    if front is Said.NOTHING or behind is Said.NOTHING:
        return _joined(front if behind is Said.NOTHING else behind, negated)
    same = isinstance(front, Verdict) and isinstance(behind, Verdict)
    if same and front.value is behind.value and not negated:
        return behind
    return Said.AMBIGUOUS


def _belongs_to_left(gap: str) -> bool:
    """Whether what stands between two statements is tied to the first: ``a(): true, b()``."""
    gap = gap.strip(" \"'")
    return gap.startswith((":", "=", "is ", "-", "|")) and not gap.endswith(":")


def _joined(said: Reading, negated: bool) -> Reading:
    """What is said of a statement that may have ``not`` in front of it."""
    if not negated:
        return said
    if said is Said.NOTHING:
        return Verdict(False)
    return Verdict(False) if isinstance(said, Verdict) and said.value is True else Said.AMBIGUOUS

"""Finding ``name(argument, ...)`` in a line, the form in which skills and atoms are written."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.vlm.parsing.names import words_of

_TOKEN = re.compile(
    r"(?<![\w?-])([A-Za-z][\w-]*+)( ?)\(|[()\]]|(?<![\w?-])([A-Za-z][\w-]*+)\[(?=[?A-Za-z])"
)
_NAME = re.compile(r"\??[A-Za-z][\w-]*+(?:::?[A-Za-z][\w-]*+)?")
_DECLARED = re.compile(r" ?:= ?| ?::? ?| ?= ?| - | of type | is an? | as ")
_REMARK = re.compile(r"\([^()]{0,200}\)")
_SEPARATOR = re.compile(r"[,;]")
_NO_NAMES = frozenset(words_of("not and or is if true false unsure yes no when that"))
_ODD = " \t\"'?<>[]{}$."


@dataclass(frozen=True)
class Call:
    """Something written as ``name(argument, ...)``.

    Attributes:
        name: as written.
        arguments: as written, split at commas; typed lists of PDDL are split as well.
        start: where it begins in the line.
        end: one past where it ends.
        tight: whether it is in the usual form, name and parenthesis touching, which is rare in
            prose.
    """

    name: str
    arguments: tuple[str, ...]
    start: int
    end: int
    tight: bool = True

    def __str__(self) -> str:
        return f"{self.name}({', '.join(self.arguments)})"

    @cached_property
    def readings(self) -> tuple[tuple[str, ...], ...]:
        """For every argument the names that it may stand for."""
        return tuple(map(argument_readings, self.arguments))


def find_calls(line: str) -> list[Call]:
    """All calls in a line, in order; Lisp's ``(name argument)`` where there is no other."""
    if "(" not in line and "[" not in line:
        return []
    spans = sorted(_spans(line))
    return list(_outermost(line, spans)) or list(_lisp_calls(line, spans))[::-1]


def argument_readings(argument: str) -> tuple[str, ...]:
    """What an argument may stand for, without quotes, question marks and remarks.

    ``item: cup`` and ``cup - item`` may stand for either side, the one behind first.
    """
    plain = _REMARK.sub("", argument)
    sides = _DECLARED.split(plain.strip(), maxsplit=1)
    readings = (side.strip(_ODD) for side in (*reversed(sides), plain))
    return tuple(dict.fromkeys(reading for reading in readings if reading))


def _spans(line: str) -> Iterator[tuple[int, int, str, int, bool]]:
    """Start, negative end, name (may be empty), start of the inside and tightness of brackets."""
    opened: list[re.Match[str]] = []
    for token in _TOKEN.finditer(line):
        sign = token.group()[-1]
        if sign in "([":
            opened.append(token)
        elif opened and (sign == ")") is (opened[-1].group()[-1] == "("):
            opening = opened.pop()
            name = opening.group(1) or opening.group(3) or ""
            name = "" if name.casefold() in _NO_NAMES else name
            start = opening.start() if name else opening.end() - 1
            yield start, -token.end(), name, opening.end(), opening.group(2) != " "


def _outermost(line: str, spans: list[tuple[int, int, str, int, bool]]) -> Iterator[Call]:
    """The named brackets that lie in no other; loose ones only where none of them is tight."""
    named = [span for span in spans if span[2]]
    end = 0
    for number, (start, negative_end, name, inside, tight) in enumerate(named):
        following = named[number + 1] if number + 1 < len(named) else None
        hides_call = following and following[4] and following[0] < -negative_end
        if start < end or (not tight and hides_call):
            continue
        end = -negative_end
        yield Call(name, _split(line[inside : end - 1]), start, end, tight)


def _lisp_calls(line: str, spans: list[tuple[int, int, str, int, bool]]) -> Iterator[Call]:
    """The brackets without a name that hold nothing but names, the last one first."""
    end = 0
    for start, negative_end, name, inside, _ in reversed(spans):  # the innermost ones
        if name or (end and -negative_end > end):
            continue
        end = start
        words = line[inside : -negative_end - 1].split()
        if words and all(word == "-" or _NAME.fullmatch(word) for word in words):
            arguments = _typed(" ".join(words[1:]), spaced=True)
            yield Call(words[0], arguments, start, -negative_end, tight=False)


def _split(inside: str) -> tuple[str, ...]:
    """Arguments between commas, those in parentheses left alone; none of them is empty."""
    if "(" not in inside:
        parts = _SEPARATOR.split(inside)
    else:
        parts, start, depth = [], 0, 0
        for place, sign in enumerate(inside):
            depth += (sign == "(") - (sign == ")")
            if sign in ",;" and depth == 0:
                parts.append(inside[start:place])
                start = place + 1
        parts.append(inside[start:])
    stripped = (part.strip() for part in parts)
    return tuple(one for part in stripped if part for one in _typed(part))


def _typed(part: str, *, spaced: bool = False) -> tuple[str, ...]:
    """``?a ?b - block ?c - table`` as three arguments; anything else as it is.

    Args:
        part: what stands between two commas.
        spaced: whether blanks alone separate arguments, as in Lisp.
    """
    words = part.split()
    typed = len(words) > 1 and ("?" in part or all(":" in word[1:-1] for word in words))
    if not (spaced or typed or words.count("-") > 1):
        return (part,)
    arguments: list[str] = []
    pending: list[str] = []
    for number, word in enumerate(words):
        if word == "-" or (number and words[number - 1] == "-"):
            if word != "-":
                arguments += [f"{name} - {word}" for name in pending]
                pending = []
        elif _NAME.fullmatch(word):
            pending.append(word)
        else:
            return (part,)
    if not spaced and not all(word.startswith("?") or ":" in word for word in pending):
        return (part,)
    return (*arguments, *pending)

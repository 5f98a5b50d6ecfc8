"""Finding ``name(argument, ...)`` in a line, the form in which skills and atoms are written."""

from __future__ import annotations

import re
from dataclasses import dataclass

# The look-behind lets a match start at the beginning of a word only: linear on any input.
_CALL = re.compile(r"(?<![\w?-])([A-Za-z][\w-]*)[ ]?\(((?:[^()\n]|\([^()\n]*\))*+)\)")
_LISP = re.compile(r"\(([A-Za-z][\w-]*)((?:\s+\??[A-Za-z][\w-]*)*+)\s*\)")
_KEYWORD = re.compile(r"^\s*\??[\w-]+\s*(?:=|:=|:)\s*(?=\S)")
_PARENTHESES = re.compile(r"\([^()]*\)")


@dataclass(frozen=True)
class Call:
    """Something written as ``name(argument, ...)``.

    Attributes:
        name: as written.
        arguments: as written, split at commas.
        start: where it begins in the line.
        end: one past where it ends.
    """

    name: str
    arguments: tuple[str, ...]
    start: int
    end: int

    def __str__(self) -> str:
        return f"{self.name}({', '.join(self.arguments)})"

    @property
    def values(self) -> tuple[str, ...]:
        """The arguments as names: without keywords, quotes, question marks and remarks."""
        return tuple(argument_value(argument) for argument in self.arguments)


def find_calls(line: str) -> list[Call]:
    """All calls in a line, in order; Lisp's ``(name argument)`` where there is no other."""
    found = [
        Call(m.group(1), _split_arguments(m.group(2)), m.start(), m.end())
        for m in _CALL.finditer(line)
    ]
    if found or "(" not in line:
        return found
    return [
        Call(m.group(1), tuple(m.group(2).split()), m.start(), m.end())
        for m in _LISP.finditer(line)
    ]


def argument_value(argument: str) -> str:
    """An argument without keyword, quotes, question mark and remarks in parentheses."""
    value = _PARENTHESES.sub("", _KEYWORD.sub("", argument, count=1))
    return value.strip(" \t\"'?<>[]{}$.")


def _split_arguments(inside: str) -> tuple[str, ...]:
    parts = (part.strip() for part in re.split(r"[,;]", inside))
    return tuple(part for part in parts if part)

"""The outer form of a goal's text: words, commas and groups in parentheses, each with its place."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from skillwrapper.errors import GoalError

EXAMPLE = "e.g. (and (is_open drawer) (not (holding robot cup))), or is_open(drawer)"

_DEEPEST = 100
_TOKEN = re.compile(r"\n|;[^\n]*|[(),]|[^\s(),;]+")


@dataclass(frozen=True)
class Place:
    """Where something stands; both count from 1."""

    line: int
    column: int

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}"


@dataclass(frozen=True)
class Word:
    """A name, a keyword or a comma."""

    text: str
    place: Place

    @property
    def lower(self) -> str:
        """The text in lower case, in which PDDL compares words."""
        return self.text.lower()


@dataclass(frozen=True)
class Group:
    """What stands between two parentheses, or the whole text."""

    items: tuple[Word | Group, ...]
    place: Place


Node = Word | Group


def goal_error(place: Place, expected: str, got: str) -> GoalError:
    """A mistake in a goal's text."""
    return GoalError(f"goal, {place}: expected {expected}, got {got}; write {EXAMPLE}")


def read_group(text: str) -> Group:
    """The whole text as a group; comments, from a semicolon to the end of its line, are left out.

    Raises:
        GoalError: if the parentheses do not match, or are nested too deep.
    """
    open_groups: list[tuple[Place, list[Node]]] = [(Place(1, 1), [])]
    for word in _words(text):
        if word.text == "(":
            open_groups.append((word.place, []))
            if len(open_groups) > _DEEPEST:
                raise GoalError(f"goal, {word.place}: nested deeper than {_DEEPEST} parentheses")
        elif word.text == ")":
            if len(open_groups) == 1:
                raise goal_error(word.place, "a literal or the end", ")")
            place, items = open_groups.pop()
            open_groups[-1][1].append(Group(tuple(items), place))
        else:
            open_groups[-1][1].append(word)
    place, items = open_groups.pop()
    if open_groups:
        raise goal_error(place, "a ')' for this '('", "the end")
    return Group(tuple(items), place)


def _words(text: str) -> Iterator[Word]:
    line, start = 1, 0
    for found in _TOKEN.finditer(text):
        if found[0] == "\n":
            line, start = line + 1, found.end()
        elif not found[0].startswith(";"):
            yield Word(found[0], Place(line, found.start() - start + 1))

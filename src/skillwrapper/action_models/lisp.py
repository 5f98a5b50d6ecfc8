"""Nested lists in parentheses, as PDDL files and traces are written, with their lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from skillwrapper.errors import FileError

_TOKEN = re.compile(r";[^\n]*|[()]|[^\s();]+|\n")


@dataclass
class Form:
    """A list in parentheses.

    Attributes:
        where: file and line of its opening parenthesis, for complaints.
        items: words in lower case, and further lists.
    """

    where: str
    items: list[str | Form] = field(default_factory=list)

    @property
    def head(self) -> str:
        """The word it starts with; empty if it starts with none."""
        return self.items[0] if self.items and isinstance(self.items[0], str) else ""

    @property
    def words(self) -> list[str]:
        """Its words, if it holds nothing else.

        Raises:
            FileError: if it holds a list.
        """
        for item in self.items:
            if isinstance(item, Form):
                raise FileError(f"{item.where}: expected a word, got a list")
        return [item for item in self.items if isinstance(item, str)]

    def __str__(self) -> str:
        return f"({' '.join(map(str, self.items))})"

    @property
    def forms(self) -> list[Form]:
        """The lists in it."""
        return [item for item in self.items if isinstance(item, Form)]


def read_form(text: str, name: str) -> Form:
    """The one list of a text; PDDL does not tell capital letters from small ones.

    Args:
        text: the text.
        name: of the file, for complaints.

    Raises:
        FileError: if there is no list, more than one, or a parenthesis too many or too few.
    """
    outermost = Form(f"{name}:1")
    nested = [outermost]
    line = 1
    for token in _tokens(text):
        if token == "\n":
            line += 1
        elif token == "(":
            form = Form(f"{name}:{line}")
            nested[-1].items.append(form)
            nested.append(form)
        elif token != ")":
            nested[-1].items.append(token)
        elif len(nested) == 1:
            raise FileError(f"{name}:{line}: this ')' closes nothing")
        else:
            nested.pop()
    if len(nested) > 1:
        raise FileError(f"{nested[-1].where}: this '(' is never closed")
    if len(outermost.items) != 1 or not outermost.forms:
        raise FileError(f"{name}:1: expected one list in parentheses, got {len(outermost.items)}")
    return outermost.forms[0]


def _tokens(text: str) -> Iterator[str]:
    for match in _TOKEN.finditer(text.lower()):
        if not match[0].startswith(";"):
            yield match[0]

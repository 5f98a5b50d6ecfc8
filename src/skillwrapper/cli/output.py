"""Printing: results to standard output, progress and errors to standard error.

What is printed comes from models, files and users, so no console of ours takes square brackets
for markup or ``:100:`` for an emoji, or passes on signs that steer a terminal; colours are given
as styles.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from typing import Annotated, Any

import typer
from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

JsonFlag = Annotated[
    bool, typer.Option("--json", help="Print one JSON object; progress goes to standard error.")
]


_STEERING = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
"""Control characters but for tab and line end, and those that turn the direction of writing."""


class _DataConsole(Console):
    """A console whose text is data: of signs that steer a terminal it prints only its own."""

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """What is printed, in pieces of one style."""
        for text, style, control in super().render(renderable, options):
            yield Segment(text if control else _STEERING.sub("", text), style, control)


def results() -> Console:
    """The console for results."""
    return _DataConsole(highlight=False, soft_wrap=True, markup=False, emoji=False)


def messages(plain: bool = False) -> Console:
    """The console for progress and errors; a plain one leaves the screen to questions."""
    terminal = False if plain else None
    return _DataConsole(
        stderr=True, highlight=False, markup=False, emoji=False, force_terminal=terminal
    )


def print_json(content: Any) -> None:
    """Print one JSON object on standard output."""
    typer.echo(json.dumps(content, indent=1, default=str))

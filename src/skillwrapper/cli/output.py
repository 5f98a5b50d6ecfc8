"""Printing: results to standard output, progress and errors to standard error.

What is printed comes from models, files and users, so no console of ours takes square brackets
for markup or ``:100:`` for an emoji; colours are given as styles.
"""

from __future__ import annotations

import json
from typing import Annotated, Any

import typer
from rich.console import Console

JsonFlag = Annotated[
    bool, typer.Option("--json", help="Print one JSON object; progress goes to standard error.")
]


def results() -> Console:
    """The console for results."""
    return Console(highlight=False, soft_wrap=True, markup=False, emoji=False)


def messages(plain: bool = False) -> Console:
    """The console for progress and errors; a plain one leaves the screen to questions."""
    terminal = False if plain else None
    return Console(stderr=True, highlight=False, markup=False, emoji=False, force_terminal=terminal)


def print_json(content: Any) -> None:
    """Print one JSON object on standard output."""
    typer.echo(json.dumps(content, indent=1, default=str))

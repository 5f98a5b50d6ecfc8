"""A console for tables with many columns."""

from __future__ import annotations

from rich.console import Console

from skillwrapper.cli.output import results

_WIDE = 240
"""Columns of tables that do not go to a terminal: a file or pipe has no width to be kept."""


def table_console() -> Console:
    """The console for results, wide if it is no terminal."""
    console = results()
    if not console.is_terminal:
        console.width = _WIDE
    return console

"""What is printed is data: no markup, no emoji, wherever it comes from."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from rich.console import Console
from rich.table import Table
from rich.text import Text

import skillwrapper
from skillwrapper.cli.output import messages, results
from skillwrapper.cli.progress import RunProgress
from skillwrapper.runs.decisions import PredicateDecision
from skillwrapper.runs.events import PredicateDecided
from skillwrapper.symbols import Predicate

HOSTILE = "on :100: [/b] [red]x[/red] [link=http://x]y[/link] \\[bold]"
SOURCES = sorted((Path(skillwrapper.__file__).parent).rglob("*.py"))


@pytest.mark.parametrize("console", [results, messages])
def test_consoles_print_what_they_are_given(console: object) -> None:
    made: Console = console()  # type: ignore[operator]
    table = Table(title=HOSTILE, box=None)
    table.add_column(HOSTILE, no_wrap=True)
    table.add_row(HOSTILE)
    made.width = 200
    with made.capture() as printed:
        made.print(HOSTILE)
        made.print(HOSTILE, style="bold")
        made.print(table)
    assert printed.get().count(HOSTILE) == 5


def test_consoles_pass_on_nothing_that_steers_the_terminal() -> None:
    """Descriptions in a domain, and what a robot says, once changed colours and titles."""
    console = results()
    steering = "a\x1b[31mb\x1b]0;c\x07d\x9b2Je\u202ef\x00g\x08h\ri"
    table = Table(title=steering, box=None)
    table.add_column(steering)
    table.add_row(Text(steering))
    with console.capture() as printed:
        console.print(steering, style="bold")
        console.print(table)
    assert printed.get().count("a[31mb]0;cd2Jefghi") == 4


def test_progress_prints_what_it_is_given() -> None:
    console = messages()
    console.width = 200
    progress = RunProgress(console)
    decision = PredicateDecision("accepted", Predicate("p", (), "x"), reason=HOSTILE)
    progress(PredicateDecided(1, decision))
    with console.capture() as printed:
        console.print(progress._draw())
    assert printed.get().count(HOSTILE) == 1


def test_there_are_no_other_consoles_and_no_markup() -> None:
    made = {"Console", "from_markup", "Prompt", "Confirm"}
    found = [
        (path.name, node.lineno)
        for path in SOURCES
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Call) and _name(node.func) in made and path.name != "output.py"
    ]
    assert found == []


def _name(function: ast.expr) -> str:
    return getattr(function, "attr", None) or getattr(function, "id", "")

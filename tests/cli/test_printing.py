"""What is printed is data: no markup, no emoji, wherever it comes from."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from rich.console import Console
from rich.table import Table

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

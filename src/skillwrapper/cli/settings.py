"""``skillwrapper settings``: everything that can be set, with default, unit and meaning."""

from __future__ import annotations

from itertools import groupby

import typer
from rich.table import Table
from rich.text import Text

from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.runs.settings import FREE, RunSettings
from skillwrapper.runs.settings_tree import Setting, list_settings


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(settings)


def settings(as_json: JsonFlag = False) -> None:
    """List all settings of a run, for --config FILE and --set NAME=VALUE."""
    known = list_settings(RunSettings)
    if as_json:
        print_json([{**s.to_json(), "may_change_on_resume": _is_free(s)} for s in known])
        return
    console = results()
    for section, members in groupby(known, key=lambda s: s.name.rpartition(".")[0]):
        console.print(Text(section or "run", style="bold"))
        table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 2))
        for name in ("name", "default", "meaning"):
            table.add_column(name, no_wrap=name == "name", overflow="fold")
        for one in members:
            table.add_row(Text(one.name), Text(_default(one)), Text(_describe(one)))
        console.print(table)
    console.print("* may change when a run is resumed; all others stay as they were")


def _is_free(one: Setting) -> bool:
    return any(one.name == name or one.name.startswith(f"{name}.") for name in FREE)


def _default(one: Setting) -> str:
    if one.required:
        return "required"
    if one.default in (None, [], {}):
        return "none"
    return str(one.default).lower() if isinstance(one.default, bool) else str(one.default)


def _describe(one: Setting) -> str:
    unit = f" [{one.unit}]" if one.unit else ""
    free = " *" if _is_free(one) else ""
    return f"{one.meaning}{unit} ({one.expected}){free}"

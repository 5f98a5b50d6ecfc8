"""``skillwrapper settings``: everything that can be set, with default, unit and meaning."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Any

import typer
from rich.table import Table
from rich.text import Text

from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.runs.settings import FREE, RunSettings
from skillwrapper.runs.settings_tree import Setting, list_settings


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(settings)


def settings(as_json: JsonFlag = False) -> None:
    """List all settings: of runs, for --config FILE and --set NAME=VALUE; and of experiments."""
    of_runs = list_settings(RunSettings)
    names = {one.name for one in of_runs}
    further = [one for one in list_settings(ExperimentSettings) if one.name not in names]
    if as_json:
        both = [*((one, "run") for one in of_runs), *((one, "experiment") for one in further)]
        print_json([_to_json(one, kind) for one, kind in both])
        return
    _print(of_runs, "run")
    _print(further, "of experiments only, beside those of runs")
    results().print("* may change when a run is resumed; all others stay as they were")


def _print(known: Sequence[Setting], title: str) -> None:
    console = results()
    for section, members in groupby(known, key=lambda one: one.name.rpartition(".")[0]):
        console.print(Text(section or title, style="bold"))
        table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 2))
        for name in ("name", "default", "meaning"):
            table.add_column(name, no_wrap=name == "name", overflow="fold")
        for one in members:
            table.add_row(Text(one.name), Text(_default(one)), Text(_describe(one)))
        console.print(table)


def _to_json(one: Setting, kind: str) -> dict[str, Any]:
    return {**one.to_json(), "of": kind, "may_change_on_resume": _is_free(one)}


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

"""``skillwrapper experiment``: run comparisons of methods, and look at what came of them."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console, JustifyMethod
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table as RichTable
from rich.text import Text

from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.readings import ReadingsOption
from skillwrapper.cli.setting_options import ConfigOption, SetOption
from skillwrapper.cli.wide_tables import table_console
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.benchmark.experiment_files import read_experiment
from skillwrapper.evaluation.benchmark.experiment_folder import ERROR, ExperimentFolder
from skillwrapper.evaluation.benchmark.plots import plot_experiment
from skillwrapper.evaluation.benchmark.ray_workers import open_ray_workers
from skillwrapper.evaluation.benchmark.running import open_workers, run_experiment
from skillwrapper.evaluation.benchmark.summary import ExperimentSummary, summarise
from skillwrapper.evaluation.benchmark.table_formats import to_csv, to_latex, to_markdown
from skillwrapper.evaluation.benchmark.workers import CellOutcome
from skillwrapper.evaluation.methods.cell import Cell

FolderArgument = Annotated[Path, typer.Argument(help="Folder of an experiment.")]


class TableFormat(StrEnum):
    """How tables are printed."""

    TERMINAL = "terminal"
    MARKDOWN = "markdown"
    LATEX = "latex"
    CSV = "csv"
    JSON = "json"


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    group = typer.Typer(help="Compare methods on test problems.", no_args_is_help=True)
    group.command()(run)
    group.command()(table)
    group.command()(plot)
    app.add_typer(group, name="experiment")


def run(
    file: Annotated[Path, typer.Argument(help="An experiment file, e.g. experiments/smoke.yaml.")],
    out: Annotated[Path, typer.Option(help="Folder of the results; an existing one is resumed.")],
    workers: Annotated[int, typer.Option(min=1, help="Cells run at the same time.")] = 1,
    ray: Annotated[
        str | None, typer.Option(help="Address of a Ray cluster: auto, local, ray://HOST:PORT.")
    ] = None,
    readings: ReadingsOption = None,
    config: ConfigOption = None,
    assignments: SetOption = None,
    as_json: JsonFlag = False,
) -> None:
    """Run all cells of an experiment; the same command again runs those that are missing."""
    assignments = assignments or []
    if readings is not None:
        assignments = [*assignments, f"readings={readings}"]
    folder = ExperimentFolder.create_or_resume(out, read_experiment(file, config, assignments))
    cells = len(folder.experiment().cells)
    opened = open_ray_workers(out, ray) if ray is not None else open_workers(out, workers)
    console = messages()
    with folder.reserved(), opened as team, _progress(console) as progress:
        changes = _changes(config, assignments)
        folder.note_run(_command(file, out, workers, ray) + changes)
        ended = _watch(progress, console, cells, folder)
        outcomes = run_experiment(folder, team, ended=ended)
    failed = [outcome for outcome in outcomes if outcome.error]
    report = summarise(folder)
    if as_json:
        errors = {outcome.cell.name: outcome.error for outcome in failed}
        print_json({"out": str(out), **report.to_json(), "failed": errors})
    else:
        _print_report(report, table_console())
        results().print(f"again:  skillwrapper experiment table {out}")
    if failed:
        raise typer.Exit(1)


def table(
    folder: FolderArgument,
    style: Annotated[
        TableFormat, typer.Option("--format", help="How to print.")
    ] = TableFormat.TERMINAL,
    as_json: JsonFlag = False,
) -> None:
    """Print the tables of an experiment, of whatever cells are finished."""
    report = summarise(ExperimentFolder.open(folder))
    writers: dict[TableFormat, Callable[[ExperimentSummary], str]] = {
        TableFormat.MARKDOWN: to_markdown,
        TableFormat.LATEX: to_latex,
        TableFormat.CSV: to_csv,
    }
    if as_json or style is TableFormat.JSON:
        print_json(report.to_json())
    elif style in writers:
        typer.echo(writers[style](report), nl=False)
    else:
        _print_report(report, table_console())


def plot(
    folder: FolderArgument,
    out: Annotated[
        Path | None, typer.Option(help="Where to write; default: plots/ in the folder.")
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """Write learning curves, noise curves and the matrix of problems as PNG."""
    cells = tuple(ExperimentFolder.open(folder).results())
    if not cells:
        raise ConfigurationError(f"{folder}: expected a finished cell, found none; run it first")
    written = plot_experiment(cells, out or folder / "plots")
    if as_json:
        print_json({"plots": [str(path) for path in written]})
    else:
        for path in written:
            results().print(str(path))


def _command(file: Path, out: Path, workers: int, ray: str | None) -> str:
    """The command as it was given, for those who want to repeat it."""
    team = f"--workers {workers}" if ray is None else f"--ray {ray}"
    return f"skillwrapper experiment run {file} --out {out} {team}"


def _changes(config: Path | None, assignments: list[str] | None) -> str:
    """The options that change settings, as they were given."""
    given = [f" --config {config}"] if config is not None else []
    return "".join((*given, *(f" --set {shlex.quote(text)}" for text in assignments or ())))


def _progress(console: Console) -> Progress:
    columns = (TextColumn("cells"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=console)


def _watch(
    progress: Progress, console: Console, cells: int, folder: ExperimentFolder
) -> Callable[[CellOutcome], None]:
    finished = sum(1 for cell in folder.experiment().cells if folder.is_finished(cell))
    task = progress.add_task("cells", total=cells, completed=finished)

    def ended(outcome: CellOutcome) -> None:
        progress.advance(task)
        if outcome.error:
            where = folder.cell(outcome.cell) / ERROR
            said = f" {outcome.cell.name}: {outcome.error} ({where})"
            console.print(Text.assemble(("failed", "red"), said))
        else:
            said = f"   {_describe(folder, outcome.cell)}"
            console.print(Text.assemble(("done", "green"), said))

    return ended


def _describe(folder: ExperimentFolder, cell: Cell) -> str:
    found = next(result for result in folder.results() if result.cell == cell)
    solved = sum(problem.solved for problem in found.problems)
    return f"{cell.name}: {solved} of {len(found.problems)} solved, {found.seconds:.0f} s"


def _print_report(report: ExperimentSummary, console: Console) -> None:
    for content in report.tables():
        shown = RichTable(title=content.title, title_justify="left", box=None, pad_edge=False)
        for number, heading in enumerate(content.headings):
            side: JustifyMethod = "right" if number else "left"
            shown.add_column(heading, justify=side, overflow="fold")
        for row in content.rows:
            shown.add_row(*row)
        console.print(shown)
        if content.note:
            console.print(content.note)
        console.print("")
    for label, text in report.made:
        console.print(f"{label}: {text}")
    console.print(report.note)

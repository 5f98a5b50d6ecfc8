"""``skillwrapper report``: a run or an experiment as one page to read."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.errors import FileNotWritableError
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.report import ReportSettings, write_experiment_report, write_report
from skillwrapper.runs.archive import RunArchive


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(report)


def report(
    run: Annotated[Path, typer.Argument(help="Folder of a run or an experiment.")],
    out: Annotated[
        Path | None, typer.Option(help="HTML file to write; default: report.html in the folder.")
    ] = None,
    episodes: Annotated[
        int, typer.Option(min=0, help="Episodes shown with their pictures, at most.")
    ] = 12,
    width: Annotated[int, typer.Option(min=32, help="Width of the pictures in pixels.")] = 224,
    as_json: JsonFlag = False,
) -> None:
    """Write one HTML file: what a run learned, from what, at what price; or how methods compare."""
    try:
        written = _write(run, out, ReportSettings(picture_width=width, episodes=episodes))
    except FileNotWritableError as error:
        advice = "; choose another place with --out" if out is None else ""
        raise FileNotWritableError(f"{error}{advice}") from error
    if as_json:
        print_json({"report": str(written), "bytes": written.stat().st_size})
    else:
        results().print(f"wrote {written}")


def _write(run: Path, out: Path | None, settings: ReportSettings) -> Path:
    if ExperimentFolder.is_one(run):
        return write_experiment_report(ExperimentFolder.open(run), out, settings.picture_width)
    return write_report(RunArchive.open(run), out, settings)

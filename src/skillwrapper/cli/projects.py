"""``skillwrapper new``, ``check`` and ``schema``: from nothing to a robot that keeps the rules."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.starting import schema_text, start_project
from skillwrapper.world.conformance import examine_environment
from skillwrapper.world.conformance_report import ConformanceReport, Level


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(new)
    app.command()(check)
    app.command()(schema)


def new(
    folder: Annotated[Path, typer.Argument(help="A new or empty folder.")],
    as_json: JsonFlag = False,
) -> None:
    """Start a project of your own: a domain, a fake robot, a test; it runs as it is."""
    files = start_project(folder)
    if as_json:
        print_json({"folder": str(folder), "files": [str(file) for file in files]})
        return
    for file in files:
        results().print(f"  {file}")
    results().print(f"try it with:  skillwrapper check {folder}")
    results().print(f"then learn:   skillwrapper learn {folder} --out run --iterations 4")


def check(
    reference: DomainArgument,
    level: Annotated[
        Level | None,
        typer.Option(
            help="What is asked: a robot's pictures may differ, a simulator repeats itself. "
            "Default: what it says that it can do."
        ),
    ] = None,
    steps: Annotated[int, typer.Option(min=1, help="How many skills to run by chance.")] = 40,
    seed: Annotated[int, typer.Option(min=0, help="Chooses the skills and starts.")] = 0,
    as_json: JsonFlag = False,
) -> None:
    """Run skills by chance, and check every rule of a robot."""
    package = find_domain(reference)
    report = examine_environment(package.make_environment, level=level, seed=seed, steps=steps)
    if as_json:
        print_json(report.to_json())
    else:
        _print_report(report)


def schema() -> None:
    """Print the JSON Schema of domain.yaml, for editors."""
    typer.echo(schema_text(), nl=False)


def _print_report(report: ConformanceReport) -> None:
    console = results()
    console.print(f"every rule of a {report.level} is kept", style="green")
    for camera, (width, height) in report.picture_sizes.items():
        console.print(f"  camera {camera}: {width} x {height} pixels")
    for name, skill in report.skills.items():
        console.print(
            f"  {name}: {skill.successes} of {skill.runs} runs succeeded, "
            f"{skill.longest:.2f} s at most"
        )
    for remark in report.remarks():
        console.print(f"note: {remark}", style="yellow")

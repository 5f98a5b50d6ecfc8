"""``skillwrapper import`` and ``serve-robot``: skills that run elsewhere, or did so before."""

from __future__ import annotations

import sys
from contextlib import closing, redirect_stdout
from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.robots.serving import serve
from skillwrapper.runs.recordings import import_recording


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command(name="import")(import_)
    app.command()(serve_robot)


def import_(
    reference: DomainArgument,
    recording: Annotated[
        Path,
        typer.Argument(
            help="A file .csv or .jsonl: episode, skill, arguments, success, before, after, scene; "
            "or a dataset of Minari or LeRobot."
        ),
    ],
    out: Annotated[Path, typer.Option(help="The folder to make.")],
    as_json: JsonFlag = False,
) -> None:
    """Make a run out of a recording, wholly or not at all; learn from it with --no-execute."""
    episodes = import_recording(find_domain(reference), recording, out)
    executions = sum(len(episode.transitions) for episode in episodes)
    if as_json:
        print_json({"run": str(out), "episodes": len(episodes), "executions": executions})
        return
    results().print(f"{executions} executions in {len(episodes)} episodes")
    results().print(f"learn from them with:  skillwrapper learn {out} --no-execute")


def serve_robot(reference: DomainArgument) -> None:
    """Be the robot of another process: answer calls on standard input (see --robot)."""
    answers = sys.stdout
    with (
        redirect_stdout(sys.stderr),  # whatever the robot prints is no answer
        closing(find_domain(reference).make_environment()) as environment,
    ):
        serve(environment, sys.stdin, answers)

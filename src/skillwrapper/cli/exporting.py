"""``skillwrapper export`` and ``import-model``: learned models leave, and come back edited."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.planning import GoalReading, RunArgument, SceneOption, read_wanted
from skillwrapper.errors import ConfigurationError, RefusedModelError
from skillwrapper.files.writing import write_atomically
from skillwrapper.planning.export import Dialect, Export
from skillwrapper.planning.unified import PROGRAM, to_unified_planning
from skillwrapper.runs.archive import RunArchive, reserved
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.runs.model_import import import_model
from skillwrapper.world.pictures import load_pictures

_REASONS = 20
"""So many reasons of a refusal are told."""


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(export)
    app.command(name="import-model")(import_model_)


def export(
    run: RunArgument,
    to: Annotated[Dialect, typer.Option(help="For whom.")],
    out: Annotated[Path | None, typer.Option(help="Folder; default: RUN/export/DIALECT.")] = None,
    scene: SceneOption = None,
    init: Annotated[
        list[str] | None, typer.Option(help="A picture of the start, [CAMERA=]FILE; one a camera.")
    ] = None,
    goal: Annotated[
        list[str] | None, typer.Option(help="A picture of the goal, or an expression; repeatable.")
    ] = None,
    positive: GoalReading = False,
    as_json: JsonFlag = False,
) -> None:
    """Write domain, problem and a table from actions to skills for other planners."""
    folder = out or run / "export" / to
    if bool(init) is not bool(goal):
        raise ConfigurationError(
            "expected both --init and --goal for a problem, or neither for the domain alone"
        )
    if to is Dialect.UP and not goal:
        raise ConfigurationError("--to up: expected --init and --goal, as it makes a problem")
    with LearnedModel.load(run) as learned:
        if init and goal:
            start = learned.read(load_pictures(init), scene=scene)
            wanted = read_wanted(learned, goal, scene, positive).as_read(start.space)
            for name in (name for name, value in start.items() if value is None):
                messages().print(f"note: {name} cannot be told from the picture; written as false")
            exported = learned.export(to, start, wanted)
        else:
            exported = learned.export(to, scene=scene)
    if to is Dialect.UP:
        to_unified_planning(exported)  # first: it must be one
        write_atomically(folder / "problem.py", PROGRAM)
    written = exported.write(folder)
    _tell(exported, written, as_json)


def _tell(exported: Export, written: tuple[Path, ...], as_json: bool) -> None:
    table = exported.table.to_json()
    if as_json:
        print_json({"files": [str(path) for path in written], **table})
        return
    console = results()
    for row in exported.table.rows:
        own, context = " ".join(row.arguments), " ".join(row.context)
        beside = f" (beside: {context})" if context else ""
        limits = ", ".join(f"{name} = {item}" for name, item in row.chosen.items())
        limited = f" where {limits}" if limits else ""
        console.print(f"{row.action}: {row.skill}({own}){beside}{limited}")
    if len(exported.problems) > 1:
        console.print(f"{len(exported.problems)} problems: to solve one of them is enough")
    console.print(f"written: {', '.join(map(str, written))}")


def import_model_(
    run: RunArgument,
    model: Annotated[Path, typer.Argument(help="An edited domain.pddl, or predicates.yaml.")],
    as_json: JsonFlag = False,
) -> None:
    """Take an edited model into a run, if all that is recorded agrees with it."""
    archive = RunArchive.open(run)
    try:
        with reserved(run):
            fit = import_model(archive, model)
    except RefusedModelError as error:
        for reason in error.reasons[1:_REASONS]:
            messages().print(f"also: {reason}", soft_wrap=True)
        raise
    operators = [learned.operator.name for learned in fit.operators]
    if as_json:
        print_json({"predicates": [p.name for p in fit.predicates], "operators": operators})
        return
    results().print(
        f"accepted: {len(fit.predicates)} predicates, {len(operators)} operators; nothing that is "
        "recorded speaks against them that did not before"
    )

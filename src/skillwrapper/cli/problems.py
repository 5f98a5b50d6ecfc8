"""``skillwrapper problems``: make test problems of a domain."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.problems.problem_files import problems_data, write_problems
from skillwrapper.evaluation.problems.problem_generator import ProblemGenerator
from skillwrapper.evaluation.problems.problem_scenes import problems_over_scenes
from skillwrapper.evaluation.problems.problems import ProblemSet
from skillwrapper.world.capabilities import Enumerable, require


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(problems)


def problems(
    domain: DomainArgument,
    out: Annotated[Path | None, typer.Option(help="The YAML file to write.")] = None,
    easy: Annotated[int, typer.Option(min=0, help="Optimal solutions of 1 to 7 skills.")] = 20,
    hard: Annotated[int, typer.Option(min=0, help="Optimal solutions of 8 to 15 skills.")] = 20,
    impossible: Annotated[int, typer.Option(min=0, help="Proven to have no solution.")] = 10,
    seed: Annotated[int, typer.Option(min=0, help="Decides every choice.")] = 0,
    scene: Annotated[str | None, typer.Option(help="One of the domain's scenes.")] = None,
    learned_in: Annotated[
        list[str] | None,
        typer.Option(
            help="A scene of learning; repeatable. Easy problems are then in these "
            "scenes, hard ones in --scene, and both of any length to 7."
        ),
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """Make test problems by exact search; the same seed makes the same ones."""
    package = find_domain(domain)
    environment = require(package.make_environment(), Enumerable, "making problems")
    if out is not None and out.exists():
        raise ConfigurationError(f"{out} exists already; choose another --out, nothing was changed")
    counts = (easy, hard, impossible)
    with messages().status("searching all states"):
        if learned_in:
            made = problems_over_scenes(
                environment, package, seed, learned_in=learned_in, scene=scene, counts=counts
            )
        else:
            environment.reset(seed=0, scene=scene)
            made = ProblemGenerator(environment, package, seed).generate(*counts)
    environment.close()
    if out is not None:
        write_problems(made, out)
    if as_json:
        print_json({"out": None if out is None else str(out), **problems_data(made)})
    else:
        _print(made, out)


def _print(made: ProblemSet, out: Path | None) -> None:
    table = Table(box=None, pad_edge=False)
    for title in ("problem", "skills", "layout", "why impossible"):
        table.add_column(title)
    for problem in made.problems:
        length = "-" if problem.length is None else str(problem.length)
        table.add_row(problem.name, length, str(problem.layout), problem.reason)
    console = results()
    console.print(table)
    if out is not None:
        console.print(f"wrote {out}")

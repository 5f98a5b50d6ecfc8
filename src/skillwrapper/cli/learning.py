"""``skillwrapper learn``: run Algorithm 1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.text import Text

from skillwrapper.cli.domain_argument import OptionalDomainArgument
from skillwrapper.cli.estimates import print_estimate
from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.progress import RunProgress
from skillwrapper.cli.setting_options import (
    BaseUrlOption,
    ConfigOption,
    PromptsOption,
    RolesOption,
    SetOption,
    UntilOption,
    option,
    options_given,
    run_settings,
)
from skillwrapper.cli.time_limits import time_limit
from skillwrapper.cli.ways_to_run import (
    ByHandOption,
    CameraOption,
    RobotOption,
    RobotTimeoutOption,
    check_ways,
    person,
    run_folder,
)
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError
from skillwrapper.robots.process import ProcessRobot
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.by_hand import learn_by_hand
from skillwrapper.runs.estimate import estimate_run
from skillwrapper.runs.launch import learn as run_learning
from skillwrapper.runs.launch import learn_recorded
from skillwrapper.runs.models import asks_person, check_models
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols.describe import describe_predicate
from skillwrapper.symbols.files import read_predicates
from skillwrapper.world.domain import Domain


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(learn)


def learn(
    context: typer.Context,
    domain: OptionalDomainArgument = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder of the run; an existing run is resumed.")
    ] = None,
    robot: RobotOption = None,
    robot_timeout: RobotTimeoutOption = 300.0,
    by_hand: ByHandOption = False,
    camera: CameraOption = None,
    no_execute: Annotated[
        bool,
        typer.Option(
            "--no-execute", help="Learn from what is recorded in a run; DOMAIN is its folder."
        ),
    ] = False,
    predicates: Annotated[
        Path | None,
        typer.Option(help="predicates.yaml to start from, e.g. of another run: tried first."),
    ] = None,
    seed: Annotated[int | None, option("seed")] = None,
    iterations: Annotated[int | None, option("iterations")] = None,
    budget: Annotated[int | None, option("budget")] = None,
    explore: Annotated[str | None, option("explore")] = None,
    learner: Annotated[str | None, option("learner")] = None,
    labels: Annotated[str | None, option("labels")] = None,
    candidates: Annotated[int | None, option("candidates")] = None,
    threshold: Annotated[float | None, option("threshold")] = None,
    model: Annotated[str | None, option("model")] = None,
    base_url: BaseUrlOption = None,
    role: RolesOption = None,
    prompts: PromptsOption = None,
    noise: Annotated[str | None, option("noise")] = None,
    parallel: Annotated[int | None, option("parallel")] = None,
    summarise: Annotated[str | None, option("summarise")] = None,
    votes: Annotated[int | None, option("votes")] = None,
    margin: Annotated[float | None, option("margin")] = None,
    timeout: Annotated[float | None, option("timeout")] = None,
    temperature: Annotated[float | None, option("temperature")] = None,
    max_output_tokens: Annotated[int | None, option("max_output_tokens")] = None,
    reasoning_effort: Annotated[str | None, option("reasoning_effort")] = None,
    image_size: Annotated[int | None, option("image_size")] = None,
    store: Annotated[Path | None, option("store")] = None,
    max_calls: Annotated[int | None, option("max_calls")] = None,
    max_cost: Annotated[float | None, option("max_cost")] = None,
    max_seconds: Annotated[float | None, option("max_seconds")] = None,
    until: UntilOption = None,
    config: ConfigOption = None,
    assignments: SetOption = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Estimate what it takes; do nothing.")
    ] = False,
    as_json: JsonFlag = False,
) -> None:
    """Run skills, look, invent predicates and learn operators; resumes an existing run."""
    options = options_given(context.params)
    if no_execute:
        if config is not None:
            raise ConfigurationError("--config: a run keeps its settings; change them with --set")
        _learn_recorded(domain or out, options, assignments or (), predicates, as_json)
        return
    if predicates is not None and domain is not None:
        options |= _known(predicates, find_domain(domain).domain)
    settings = run_settings(config, options, assignments or ())
    if dry_run:
        _estimate(settings, as_json)
        return
    check_ways(robot, by_hand, camera)
    folder = run_folder(out, "learning")
    plain = by_hand or asks_person(settings.model)
    with RunProgress(messages(plain)) as progress, time_limit(settings.calls.max_seconds):
        if by_hand:
            tell = partial(typer.echo, err=True)
            result = learn_by_hand(settings, folder, person(camera), tell, observers=[progress])
        elif robot is not None:
            with ProcessRobot(robot, settings.domain, robot_timeout) as process:
                result = run_learning(settings, folder, environment=process, observers=[progress])
        else:
            result = run_learning(settings, folder, observers=[progress])
    _tell_result(folder, progress, result, as_json)


def _learn_recorded(
    run: str | Path | None,
    options: Mapping[str, tuple[str, Any]],
    assignments: Sequence[str],
    predicates: Path | None,
    as_json: bool,
) -> None:
    if run is None:
        raise ConfigurationError("--no-execute: expected the folder of a run, as in: learn RUN")
    folder = Path(run)
    archive = RunArchive.open(folder)
    given = {name: value for name, value in options.items() if name != "domain"}
    if predicates is not None:
        given |= _known(predicates, archive.domain())
    settings = run_settings(archive.layout.config, given, assignments)
    plain = asks_person(settings.model)
    with RunProgress(messages(plain)) as progress, time_limit(settings.calls.max_seconds):
        result = learn_recorded(folder, settings, observers=[progress])
    _tell_result(folder, progress, result, as_json)


def _known(path: Path, domain: Domain) -> dict[str, tuple[str, Any]]:
    """The predicates of a file, as a setting."""
    told = [describe_predicate(predicate) for predicate in read_predicates(path, domain)]
    return {"predicates": ("--predicates", told)}


def _tell_result(out: Path, progress: RunProgress, result: LearningResult, as_json: bool) -> None:
    if as_json:
        calls = {"model_calls": progress.calls, "calls_made": progress.calls_made}
        print_json({"run": str(out), **calls, **result.figures.model_dump()})
    else:
        _print_result(out, result)


def _estimate(settings: RunSettings, as_json: bool) -> None:
    check_models(settings)
    estimate = estimate_run(settings)
    if as_json:
        print_json(estimate.to_json())
    else:
        print_estimate(estimate, results())


def _print_result(out: Path, result: LearningResult) -> None:
    console = results()
    figures = result.figures
    learned = f"{figures.predicates} predicates, {figures.operators} operators"
    console.print(Text.assemble((learned, "bold"), f" from {figures.executions} executions"))
    for predicate in result.fit.predicates:
        console.print(f"  {predicate.signature}: {predicate.semantics}")
    broken = figures.lemma1_violations + figures.theorem1_violations
    colour = "green" if broken == 0 and not figures.inconsistencies else "yellow"
    console.print(
        f"Lemma 1: {figures.lemma1_violations} violations, Theorem 1: "
        f"{figures.theorem1_violations} violations, {figures.inconsistencies} "
        f"inconsistencies left",
        style=colour,
    )
    console.print(f"look at it with:  skillwrapper show {out}")
    console.print(f"check it with:    skillwrapper verify {out}")

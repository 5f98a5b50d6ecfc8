"""``skillwrapper learn``: run Algorithm 1."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.estimates import print_estimate
from skillwrapper.cli.model_options import (
    BaseUrlOption,
    MarginOption,
    MaxCallsOption,
    MaxCostOption,
    MaxSecondsOption,
    ModelOption,
    ParallelOption,
    PromptsOption,
    RolesOption,
    StoreOption,
    Until,
    VotesOption,
    parse_roles,
)
from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.progress import RunProgress
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.learning.settings import LearningSettings
from skillwrapper.runs.assistants import Spending, check_models
from skillwrapper.runs.config import ModelSettings, RunConfig
from skillwrapper.runs.estimate import estimate_run
from skillwrapper.runs.learn import learn as run_learning
from skillwrapper.runs.loop import LearningResult
from skillwrapper.vlm.limits import CallLimits
from skillwrapper.vlm.settings import AssistantSettings


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(learn)


def learn(
    domain: DomainArgument,
    out: Annotated[Path, typer.Option(help="Folder of the run; an existing run is resumed.")],
    seed: Annotated[int, typer.Option(min=0, help="Decides everything left to chance.")] = 0,
    iterations: Annotated[int, typer.Option(min=1, help="How often to explore and learn.")] = 5,
    budget: Annotated[int, typer.Option(min=1, help="Skills executed in an iteration.")] = 15,
    candidates: Annotated[int, typer.Option(min=1, help="Sequences asked for at once.")] = 5,
    threshold: Annotated[float, typer.Option(min=0.0, max=1.0, help="Least score h.")] = 0.6,
    model: ModelOption = "embedded",
    base_url: BaseUrlOption = None,
    role: RolesOption = None,
    prompts: PromptsOption = None,
    noise: Annotated[str, typer.Option(help="Noise of the embedded model: none, gpt5.")] = "none",
    parallel: ParallelOption = 1,
    votes: VotesOption = 1,
    margin: MarginOption = 0.0,
    store: StoreOption = None,
    max_calls: MaxCallsOption = None,
    max_cost: MaxCostOption = None,
    max_seconds: MaxSecondsOption = None,
    until: Annotated[
        Until | None, typer.Option(help="Stop when an iteration brings nothing new.")
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Estimate what it takes; do nothing.")
    ] = False,
    as_json: JsonFlag = False,
) -> None:
    """Run skills, look, invent predicates and learn operators; resumes an existing run."""
    config = RunConfig(
        domain=domain,
        seed=seed,
        iterations=iterations,
        until_converged=until is Until.CONVERGED,
        exploration=ExplorationSettings(budget=budget, candidates=candidates),
        learning=LearningSettings(threshold=threshold),
        model=ModelSettings(
            name=model,
            roles=parse_roles(role or ()),
            noise=noise,
            base_url=base_url,
            prompts=str(prompts.resolve()) if prompts else None,
            assistant=AssistantSettings(parallel=parallel, votes=votes, margin=margin),
        ),
    )
    if dry_run:
        _estimate(config, as_json)
        return
    spending = Spending(CallLimits(max_calls, max_cost, max_seconds), store)
    with RunProgress(messages()) as progress:
        result = run_learning(config, out, progress, spending)
    if as_json:
        calls = {"model_calls": progress.calls, "calls_made": progress.calls_made}
        print_json({"run": str(out), **calls, **result.to_json()})
    else:
        _print_result(out, result)


def _estimate(config: RunConfig, as_json: bool) -> None:
    check_models(config)
    estimate = estimate_run(config)
    if as_json:
        print_json(estimate.to_json())
    else:
        print_estimate(estimate, results())


def _print_result(out: Path, result: LearningResult) -> None:
    console = results()
    figures = result.to_json()
    console.print(
        f"[bold]{figures['predicates']} predicates, {figures['operators']} operators[/] from "
        f"{figures['executions']} executions"
    )
    for predicate in result.fit.predicates:
        console.print(f"  {predicate.signature}: {predicate.semantics}", markup=False)
    broken = figures["lemma1_violations"] + figures["theorem1_violations"]
    colour = "green" if broken == 0 and not figures["inconsistencies"] else "yellow"
    console.print(
        f"[{colour}]Lemma 1: {figures['lemma1_violations']} violations, Theorem 1: "
        f"{figures['theorem1_violations']} violations, {figures['inconsistencies']} "
        f"inconsistencies left[/]"
    )
    console.print(f"look at it with:  skillwrapper show {out}", markup=False)
    console.print(f"check it with:    skillwrapper verify {out}", markup=False)

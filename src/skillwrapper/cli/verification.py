"""Running and printing exact verification."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from skillwrapper.domains.registry import make_environment
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.state_truth import TRUTH_LAYOUT
from skillwrapper.evaluation.verification import Verification, verify
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.run.assistants import open_assistant
from skillwrapper.run.learned import LearnedRun
from skillwrapper.symbols import AtomSpace
from skillwrapper.world.environment import EnumerableEnvironment


def run_verification(
    learned: LearnedRun, layout_seed: int | None, console: Console
) -> Verification:
    """Verify the model of a run, read by the run's own model.

    Raises:
        ConfigurationError: if the states of the domain cannot be listed.
    """
    config = learned.folder.config()
    environment = make_environment(config.domain)
    if not isinstance(environment, EnumerableEnvironment):
        raise ConfigurationError(
            f"{config.domain}: its states cannot be listed, so there is no exact verification"
        )
    with open_assistant(config, learned.folder, learning=False) as session:
        truth = TruthTable(environment.domain, session.assistant)
        space = AtomSpace(learned.model.predicates, environment.domain.objects)
        with console.status("reading the pictures of all reachable states"):
            verification = verify(
                environment,
                learned.model,
                lambda observations: truth.labels(space, observations),
                seed=TRUTH_LAYOUT if layout_seed is None else layout_seed,
            )
    environment.close()
    return verification


def print_verification(verification: Verification, console: Console) -> None:
    """Print figures, verdicts and counterexamples."""
    figures = verification
    console.print(
        f"{figures.states} states, {figures.pairs} pairs of state and skill instance, "
        f"{figures.seconds:.1f} s"
    )
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    for title in ("precision", "recall", "effect accuracy"):
        table.add_column(title, justify="right")
    rows = [("all", figures.precision, figures.recall, figures.effect_accuracy)]
    rows += [
        (
            name,
            figures.precision_by_skill[name],
            figures.recall_by_skill[name],
            figures.effect_accuracy_by_skill[name],
        )
        for name in figures.recall_by_skill
    ]
    for name, *values in rows:
        table.add_row(name, *(f"{v:.3f}" for v in values))
    console.print(table)
    answers = {True: "[green]yes[/]", False: "[red]no[/]", None: "not decided"}
    for verdict in ("sound", "complete", "suitable"):
        console.print(f"{verdict}: {answers[getattr(figures, verdict)]}")
    for example in figures.counterexamples:
        path = ", ".join(map(str, example.path)) or "the start"
        console.print(f"  not {example.verdict}: {example.reason}", markup=False)
        console.print(f"    after {path}: {example.instance}", markup=False)
        if example.difference:
            console.print(f"    differs in {', '.join(example.difference)}", markup=False)

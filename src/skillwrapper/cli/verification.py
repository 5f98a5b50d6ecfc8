"""``skillwrapper verify``: whether what was learned is true, in every state."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.evaluation.exact.labelled_states import TRUTH_LAYOUT
from skillwrapper.evaluation.exact.learning_curves import CurvePoint, area_under
from skillwrapper.evaluation.exact.run_checks import (
    CheckOptions,
    LabelSource,
    RunCheck,
    check_run,
)
from skillwrapper.evaluation.exact.tallies import worded
from skillwrapper.evaluation.exact.verdicts import Verdict
from skillwrapper.evaluation.exact.verification import Counterexample, Verification
from skillwrapper.evaluation.exact.vocabulary import Vocabulary
from skillwrapper.runs.archive import RunArchive

_CURVE_COLUMNS = (
    "executions", "precision", "recall", "effect accuracy", "predicates", "operators",
)  # fmt: skip
_COLOURS = {Verdict.HOLDS: "green", Verdict.FAILS: "red"}
_MOST_FACTS = 8
_WHO = {
    LabelSource.TRUE: "labels without error: the learned model is judged",
    LabelSource.MODEL: "labels read by the run's own model: it is judged as well",
}


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command()(verify)


def verify(
    run: Annotated[Path, typer.Argument(help="Folder of a run.")],
    labels: Annotated[
        LabelSource | None,
        typer.Option(
            help="true: labels without error; model: read by the run's own model. "
            "Default: true where the domain has an exact reader."
        ),
    ] = None,
    scene: Annotated[
        list[str] | None, typer.Option(help="One of the domain's scenes; repeatable; default: all.")
    ] = None,
    max_calls: Annotated[
        int | None, typer.Option(min=0, help="Stop after so many calls of the run's own model.")
    ] = None,
    layout_seed: Annotated[
        int | None, typer.Option(min=0, help="Layout of the pictures; default: one not seen.")
    ] = None,
    curve: Annotated[
        bool,
        typer.Option(
            "--curve", help="Check every iteration's model; keep the curve for the report."
        ),
    ] = False,
    as_json: JsonFlag = False,
) -> None:
    """Compare the model with the domain in every reachable state of every scene."""
    layout = TRUTH_LAYOUT if layout_seed is None else layout_seed
    options = CheckOptions(labels, tuple(scene or ()), layout, max_calls, curve)
    archive = RunArchive.open(run)
    with messages().status("labelling all reachable states"):
        checked = check_run(archive, options)
    if as_json:
        print_json(checked.to_json())
    else:
        print_check(checked, results())


def print_check(checked: RunCheck, console: Console) -> None:
    """Print figures, verdicts and counterexamples, and the curve if there is one."""
    console.print(_WHO[checked.labels])
    if checked.not_understood:
        console.print(f"nobody understands: {', '.join(checked.not_understood)}")
    found = checked.verification
    for part in found.parts:
        console.print(f"\nscene {part.scenes[0]}", style="bold")
        _print_figures(part, console)
    if found.parts:
        console.print("\nall scenes", style="bold")
    _print_figures(found, console)
    for example in found.counterexamples:
        _print_example(example, console, named=len(found.scenes) > 1)
    if checked.curve:
        print_curve(checked.curve, console)


def print_curve(curve: Sequence[CurvePoint], console: Console) -> None:
    """Print a learning curve with the area under its recall."""
    table = Table(box=None, pad_edge=False)
    for number, title in enumerate(_CURVE_COLUMNS):
        table.add_column(title, justify="right" if number else "left")
    for p in curve:
        shares = map(worded, (p.precision, p.recall, p.effect_accuracy))
        table.add_row(str(p.executions), *shares, str(p.predicates), str(p.operators))
    console.print(table)
    area = area_under([(p.executions, p.recall) for p in curve])
    console.print(f"area under recall: {worded(area)}")


def _print_figures(found: Verification, console: Console) -> None:
    console.print(
        f"{found.states} states, {found.pairs} pairs of state and skill instance, "
        f"{found.undecided} undecided, {found.seconds:.1f} s"
    )
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    for title in ("precision", "recall", "effect accuracy"):
        table.add_column(title, justify="right")
    for name, tally in {"all": found.total, **found.by_skill}.items():
        shares = (tally.precision, tally.recall, tally.effect_accuracy)
        table.add_row(name, *map(worded, shares))
    console.print(table)
    if found.vocabulary is not None:
        _print_vocabulary(found.vocabulary, console)
    for name in ("sound", "complete", "suitable"):
        verdict = getattr(found.verdicts, name)
        console.print(Text.assemble(f"{name}: ", (str(verdict), _COLOURS.get(verdict, ""))))


def _print_vocabulary(vocabulary: Vocabulary, console: Console) -> None:
    facts = vocabulary.undetermined
    told = vocabulary.varying - len(facts)
    console.print(
        f"vocabulary: {worded(vocabulary.share)} "
        f"({told} of {vocabulary.varying} varying facts are determined by the labels)"
    )
    if facts:
        more = ", ..." if len(facts) > _MOST_FACTS else ""
        console.print(f"  not determined: {', '.join(map(str, facts[:_MOST_FACTS]))}{more}")


def _print_example(example: Counterexample, console: Console, *, named: bool) -> None:
    path = ", ".join(map(str, example.path)) or "the start"
    where = f" (scene {example.scene})" if named else ""
    console.print(f"  not {example.verdict}: {example.reason}{where}")
    console.print(f"    after {path}: {example.instance}")
    if example.difference:
        console.print(f"    differs in {', '.join(example.difference)}")

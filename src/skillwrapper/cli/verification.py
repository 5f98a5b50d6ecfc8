"""Running and printing exact verification."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rich.console import Console
from rich.table import Table
from rich.text import Text

from skillwrapper.domains.discovery import find_domain
from skillwrapper.evaluation.exact.learning_curves import (
    CurvePoint,
    area_under,
    learning_curve,
    read_stages,
    write_curve,
)
from skillwrapper.evaluation.exact.state_truth import TRUTH_LAYOUT, StateTruth
from skillwrapper.evaluation.exact.verification import Verification, verify_labels
from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.world.capabilities import Enumerable, require

_CURVE_COLUMNS = (
    "executions", "precision", "recall", "effect accuracy", "predicates", "operators",
)  # fmt: skip


@dataclass(frozen=True)
class Checked:
    """What came of checking a run.

    Attributes:
        verification: of its final model.
        curve: of the model after every iteration; empty if it was not asked for.
    """

    verification: Verification
    curve: tuple[CurvePoint, ...] = ()

    def to_json(self) -> dict[str, object]:
        """Plain data: the verification, and the curve if there is one."""
        curve = {"curve": [vars(point) for point in self.curve]} if self.curve else {}
        return {**self.verification.to_json(), **curve}


def run_verification(
    archive: RunArchive, layout_seed: int | None, console: Console, *, curve: bool = False
) -> Checked:
    """Verify the model of a run, read by the run's own model.

    Args:
        archive: the run.
        layout_seed: of the layout of the pictures; None for the usual one.
        console: for progress.
        curve: also check the model of every iteration, and keep the curve in the run's folder.

    Raises:
        ConfigurationError: if the states of the domain cannot be listed.
    """
    started = time.monotonic()
    settings, model = archive.settings(), archive.latest().model
    package = find_domain(settings.domain)
    environment = require(package.make_environment(), Enumerable, "exact verification")
    layout = TRUTH_LAYOUT if layout_seed is None else layout_seed
    with (
        open_session(settings, archive.layout.calls, learning=False) as session,
        console.status("reading the pictures of all reachable states"),
    ):
        table = TruthTable(environment.domain, session.assistant)
        truth = StateTruth(environment, layout=layout, sight=table)
        atoms = AtomSpace(model.predicates, environment.domain.objects)
        labels = truth.labels(atoms)
        found = verify_labels(environment, truth.space, model, labels)
        points: tuple[CurvePoint, ...] = ()
        if curve:
            stages = read_stages(archive)
            points = learning_curve(stages, truth.space, truth.labels)
            write_curve(archive, points)
    environment.close()
    return Checked(replace(found, seconds=time.monotonic() - started), points)


def print_curve(curve: Sequence[CurvePoint], console: Console) -> None:
    """Print a learning curve with the area under its recall."""
    table = Table(box=None, pad_edge=False)
    for number, title in enumerate(_CURVE_COLUMNS):
        table.add_column(title, justify="right" if number else "left")
    for p in curve:
        shares = (f"{v:.3f}" for v in (p.precision, p.recall, p.effect_accuracy))
        table.add_row(str(p.executions), *shares, str(p.predicates), str(p.operators))
    console.print(table)
    area = area_under([(p.executions, p.recall) for p in curve])
    console.print(f"area under recall: {area:.3f}")


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
    answers = {True: ("yes", "green"), False: ("no", "red"), None: ("not decided", "")}
    for verdict in ("sound", "complete", "suitable"):
        console.print(Text.assemble(f"{verdict}: ", answers[getattr(figures, verdict)]))
    for example in figures.counterexamples:
        path = ", ".join(map(str, example.path)) or "the start"
        console.print(f"  not {example.verdict}: {example.reason}", markup=False)
        console.print(f"    after {path}: {example.instance}", markup=False)
        if example.difference:
            console.print(f"    differs in {', '.join(example.difference)}", markup=False)

"""``skillwrapper show``: what was learned."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table
from rich.text import Text

from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.errors import ConfigurationError
from skillwrapper.runs.archive import ArchivedIteration, RunArchive
from skillwrapper.runs.archive.pictures import PictureStore
from skillwrapper.runs.archive.records import to_plain
from skillwrapper.runs.estimated_noise import estimate_profile, print_profile
from skillwrapper.runs.imported_model import imported_note
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.symbols.pddl import print_domain

_MOST_OVERRULED = 10
"""Overruled readings that are shown; ``--json`` tells all."""

RunArgument = Annotated[Path, typer.Argument(help="Folder of a run.")]


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(show)


def show(
    run: RunArgument,
    pddl: Annotated[bool, typer.Option("--pddl", help="Print the PDDL domain only.")] = False,
    noise: Annotated[
        bool,
        typer.Option(
            "--noise-profile", help="Print how pictures are misread, as --noise takes it."
        ),
    ] = False,
    as_json: JsonFlag = False,
) -> None:
    """Show predicates, operators and certificate of a run."""
    archive = RunArchive.open(run)
    learned = archive.latest()
    if noise:
        typer.echo(_noise_profile(run, learned), nl=False)
    elif as_json:
        print_json(_describe(learned) | {"imported": imported_note(archive)})
    elif pddl:
        typer.echo(print_domain(learned.model), nl=False)
    else:
        _print(learned, archive.pictures, imported_note(archive))


def _describe(learned: ArchivedIteration) -> dict[str, object]:
    model = learned.model
    return {
        "summary": to_plain(learned.summary),
        "predicates": [
            {
                "name": p.name,
                "types": list(p.types),
                "semantics": p.semantics,
                "agreement": learned.agreement(p),
            }
            for p in model.predicates
        ],
        "operators": [describe_operator(o, learned.untested(o)) for o in model.operators],
        "open": {o.name: dict(learned.open_conditions(o)) for o in model.operators},
        "certificate": to_plain(learned.certificate),
        "decoding": to_plain(learned.decoding) if learned.decoding else None,
        "unresolved": [to_plain(cause) for cause in learned.unresolved],
    }


def _noise_profile(run: Path, learned: ArchivedIteration) -> str:
    if learned.decoding is None:
        raise ConfigurationError(
            f"{run}: its labels were not decoded, so nothing is known of misreading; learn with "
            "--labels decoded or --learner robust"
        )
    source = f"estimated without the truth from {learned.decoding.readings} readings of a run"
    return print_profile(estimate_profile(learned.decoding, learned.model.predicates, source))


def _print(learned: ArchivedIteration, pictures: PictureStore, imported: str) -> None:
    console = results()
    console.print("predicates", style="bold")
    for predicate in learned.model.predicates:
        console.print(f"  {predicate.signature}", style="cyan")
        console.print(f"      {predicate.semantics}")
        agreement = learned.agreement(predicate)
        if agreement is not None:
            console.print(f"      agreement of the votes: {agreement:.1%}")
        rates = learned.decoding.rates_of(predicate.name) if learned.decoding else None
        if rates is not None:
            wrong = f"{rates.false_positive:.1%} of false, {rates.false_negative:.1%} of true atoms"
            console.print(f"      misread, as estimated: {wrong}")
    console.print("\noperators", style="bold")
    if imported:
        console.print(f"  note: {imported}", markup=False)
    for operator in learned.model.operators:
        for line in describe_operator(operator, learned.untested(operator)).splitlines():
            console.print(f"  {line}")
        for condition, chance in learned.open_conditions(operator):
            console.print(
                f"    open: {condition}, needed with probability {chance:.2f}; to be decided where "
                f"{operator.skill} is tried and only this is not met"
            )
        console.print("")
    _print_certificate(learned)
    _print_decoding(learned, pictures)
    _print_unresolved(learned, pictures)


def _print_certificate(learned: ArchivedIteration) -> None:
    console, certificate = results(), learned.certificate
    table = Table.grid(padding=(0, 2))
    table.add_row("transitions", str(certificate.transitions))
    table.add_row("decided", str(certificate.decided))
    table.add_row("undecided (unknown labels)", str(certificate.undecided))
    table.add_row("successes that changed nothing", str(certificate.no_ops))
    table.add_row("violations of Lemma 1", str(certificate.lemma1_violations))
    table.add_row("violations of Theorem 1", str(certificate.theorem1_violations))
    table.add_row("inconsistencies left", str(learned.summary.inconsistencies))
    if certificate.explained is not None:
        table.add_row("explained, of the decided", f"{certificate.explained:.1%}")
    table.add_row("overruled", str(len(certificate.left_out)))
    console.print(Text.assemble(("certificate", "bold"), " (on the recorded data)"))
    console.print(table)
    for violation in certificate.violations:
        console.print(
            f"  {violation.statement}: {violation.skill}, transition {violation.transition}: "
            f"{violation.reason}",
        )
    for one in certificate.left_out:
        console.print(f"  overruled: {one.skill}, transition {one.transition}: {one.reason}")


def _print_decoding(learned: ArchivedIteration, pictures: PictureStore) -> None:
    decoding = learned.decoding
    if decoding is None:
        return
    console = results()
    console.print(
        f"  of {decoding.readings} readings {len(decoding.overruled)} are taken for mistakes; "
        f"{decoding.in_doubt} atoms are in doubt",
    )
    for one in decoding.overruled[:_MOST_OVERRULED]:
        where = ", ".join(str(pictures.path(sha)) for sha in one.pictures)
        read = "true" if one.read else "false"
        chance = f"true with probability {one.posterior:.2f}"
        console.print(f"    {one.atom}: read as {read}, {chance}: {where}")


def _print_unresolved(learned: ArchivedIteration, pictures: PictureStore) -> None:
    console = results()
    for cause in learned.unresolved:
        who = " / ".join(w.instance for w in cause.witnesses)
        console.print(f"  unresolved ({cause.kind}): {who}")
        for witness in cause.witnesses:
            for sha in witness.before:
                console.print(f"    {witness.instance}: {pictures.path(sha)}")

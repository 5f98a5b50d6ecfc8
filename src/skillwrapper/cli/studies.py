"""``skillwrapper study``: how far a model's eyes and ideas can be relied on."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from skillwrapper.cli.domain_argument import DomainArgument
from skillwrapper.cli.output import JsonFlag, messages, print_json
from skillwrapper.cli.wide_tables import table_console
from skillwrapper.evaluation.study.conditions import CONDITIONS, find_conditions
from skillwrapper.evaluation.study.invention import study_invention
from skillwrapper.evaluation.study.models import StudiedModel
from skillwrapper.evaluation.study.perception import study_perception
from skillwrapper.evaluation.study.profiles import profile_of_study
from skillwrapper.evaluation.study.subjects import subject_of
from skillwrapper.evaluation.study.tables import (
    StudyTable,
    invention_tables,
    perception_tables,
)
from skillwrapper.files.writing import write_atomically
from skillwrapper.runs.estimated_noise import print_profile

ModelsOption = Annotated[
    list[str] | None,
    typer.Option("--model", help="embedded, embedded:NOISE, openai:NAME, ...; repeatable."),
]
NoiseOption = Annotated[str, typer.Option(help="Noise of the embedded model: none, gpt5.")]
SeedOption = Annotated[int, typer.Option(min=0, help="Decides what is sampled.")]
CallsOption = Annotated[
    Path | None, typer.Option(help="File that keeps every call; what it knows is not asked again.")
]
MarkdownOption = Annotated[Path | None, typer.Option(help="Also write the tables as Markdown.")]


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    group = typer.Typer(
        help="How far a model's eyes and ideas can be relied on.", no_args_is_help=True
    )
    group.command()(perception)
    group.command()(invention)
    app.add_typer(group, name="study")


def perception(
    target: Annotated[str, typer.Argument(help="A domain, or the folder of a run.")],
    model: ModelsOption = None,
    noise: NoiseOption = "none",
    pictures: Annotated[int, typer.Option(min=1, help="Pictures under each condition.")] = 40,
    conditions: Annotated[
        str, typer.Option(help=f"Some of: {','.join(CONDITIONS)}; default: all.")
    ] = "",
    labels: Annotated[
        Path | None, typer.Option(help="YAML: pictures of your own with their true atoms.")
    ] = None,
    seed: SeedOption = 0,
    calls: CallsOption = None,
    markdown: MarkdownOption = None,
    write_profile: Annotated[
        Path | None,
        typer.Option(
            help="Also write how one model misread under one condition, for --noise FILE (.yaml)."
        ),
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """Compare what models read off pictures with the truth, under several conditions."""
    chosen = find_conditions([c.strip() for c in conditions.split(",") if c.strip()])
    subject = subject_of(target, labels=labels, pictures=pictures, seed=seed)
    with messages().status("reading") as status:
        study = study_perception(
            subject, _models(model, noise), chosen, seed=seed, calls=calls, progress=status.update
        )
    if write_profile is not None:
        write_atomically(write_profile, print_profile(profile_of_study(study)))
    _show(perception_tables(study), study.to_json(), markdown, as_json)


def invention(
    domain: DomainArgument,
    model: ModelsOption = None,
    noise: NoiseOption = "none",
    runs: Annotated[int, typer.Option(min=1, help="How often each pair is put to a model.")] = 3,
    states: Annotated[
        int, typer.Option(min=0, help="States in which meanings are compared; 0 for all.")
    ] = 400,
    pairs: Annotated[
        Path | None, typer.Option(help="Contrastive pairs of your own instead of the domain's.")
    ] = None,
    seed: SeedOption = 0,
    calls: CallsOption = None,
    markdown: MarkdownOption = None,
    as_json: JsonFlag = False,
) -> None:
    """Let models invent predicates for curated pairs, and compare with the targets' meaning."""
    with messages().status("inventing") as status:
        study = study_invention(
            domain,
            _models(model, noise),
            runs=runs,
            states=states or None,
            seed=seed,
            pairs_file=pairs,
            calls=calls,
            progress=status.update,
        )
    _show(invention_tables(study), study.to_json(), markdown, as_json)


def _models(names: list[str] | None, noise: str) -> tuple[StudiedModel, ...]:
    models = (StudiedModel.parse(name, noise) for name in names or ["embedded"])
    return tuple(dict.fromkeys(models))


def _show(
    tables: Iterable[StudyTable], content: object, markdown: Path | None, as_json: bool
) -> None:
    tables = tuple(tables)
    if markdown is not None:
        write_atomically(markdown, "\n".join(table.to_markdown() for table in tables))
    if as_json:
        print_json(content)
        return
    for table in tables:
        _print(table)


def _print(table: StudyTable) -> None:
    console = table_console()
    shown = Table(title=table.title, title_justify="left", title_style="bold", box=None)
    for number, column in enumerate(table.columns):
        shown.add_column(column, justify="right" if number else "left", overflow="fold")
    for row in table.rows:
        shown.add_row(*row)
    console.print(shown)
    for note in table.notes:
        console.print(note, style="dim")
    console.print("")

"""``skillwrapper explain`` and ``diff``: why a model is as it is, and what another has."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.output import JsonFlag, print_json, results
from skillwrapper.cli.planning import RunArgument
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.pictures import PictureStore
from skillwrapper.runs.comparison import Difference, compare
from skillwrapper.runs.explanation import Explanation, PlacedTransition, Reason, explain
from skillwrapper.runs.recollection import Recollection
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.world.observation import Observation

_SHOWN = 3
"""Transitions that are shown of each literal; one that is asked for shows all, as ``--json``."""


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command(name="explain")(explain_operator)
    app.command()(diff)


def explain_operator(
    run: RunArgument,
    operator: Annotated[str, typer.Argument(help="Name of an operator, as show prints it.")],
    literal: Annotated[
        str | None, typer.Argument(help="One of its literals, as explain prints it.")
    ] = None,
    as_json: JsonFlag = False,
) -> None:
    """Tell which transitions and pictures an operator rests on, and what is open of it."""
    archive = RunArchive.open(run)
    found = explain(Recollection.of(archive), operator)
    reasons = found.reasons if literal is None else (found.reason(literal),)
    if as_json:
        print_json(_describe(found, reasons, archive.pictures))
        return
    console = results()
    if literal is None:
        console.print(describe_operator(found.learned.operator))
        console.print(f"\nrests on {len(found.successes)} successes", style="bold")
        _print_transitions(found.successes[:_SHOWN], archive.pictures)
    for reason in reasons:
        _print_reason(reason, archive.pictures, None if literal else _SHOWN)
    if literal is None:
        for smallest in found.smallest[:_SHOWN]:
            needs = ", ".join(sorted(map(str, smallest))) or "nothing"
            console.print(f"\nwould explain everything as well, with least conditions: {needs}")


def diff(
    first: Annotated[Path, typer.Argument(help="Folder of a run.")],
    second: Annotated[Path, typer.Argument(help="Folder of another run.")],
    as_json: JsonFlag = False,
) -> None:
    """Compare vocabulary, operators and evidence of two runs."""
    found = compare(RunArchive.open(first), RunArchive.open(second))
    if as_json:
        print_json(found.to_json())
    else:
        _print_difference(found, first, second)


def _print_reason(reason: Reason, pictures: PictureStore, most: int | None) -> None:
    console = results()
    chance = "" if reason.chance is None else f" (needed with probability {reason.chance:.2f})"
    console.print(f"\n{reason.literal}: {reason.standing}{chance}", style="bold")
    console.print(f"  without it: {reason.consequence}")
    _print_transitions(reason.rests_on[:most], pictures)
    left = len(reason.rests_on[most:]) if most else 0
    if left:
        console.print(f"  and {left} more: name the literal to see all")


def _print_transitions(found: Sequence[PlacedTransition], pictures: PictureStore) -> None:
    for one in found:
        results().print(f"  {one}")
        before, after = (_files(o, pictures) for o in (one.transition.before, one.transition.after))
        results().print(f"    {' '.join(before)} -> {' '.join(after)}")


def _files(seen: Observation, pictures: PictureStore) -> list[str]:
    return [str(pictures.path(picture.sha256)) for picture in seen.pictures]


def _describe(
    found: Explanation, reasons: Sequence[Reason], pictures: PictureStore
) -> dict[str, object]:
    return {
        "operator": found.learned.operator.name,
        "successes": [_placed(one, pictures) for one in found.successes],
        "literals": [
            {
                "literal": reason.literal,
                "standing": str(reason.standing),
                "probability": reason.chance,
                "without": reason.consequence,
                "rests_on": [_placed(one, pictures) for one in reason.rests_on],
            }
            for reason in reasons
        ],
        "most_general": [sorted(map(str, smallest)) for smallest in found.smallest],
    }


def _placed(one: PlacedTransition, pictures: PictureStore) -> dict[str, object]:
    return {
        "episode": one.episode,
        "step": one.step,
        "instance": str(one.transition.instance),
        "success": one.transition.success,
        "before": _files(one.transition.before, pictures),
        "after": _files(one.transition.after, pictures),
    }


def _print_difference(found: Difference, first: Path, second: Path) -> None:
    console = results()
    console.print(f"- {first}\n+ {second}")
    for title, lines in found.sections:
        console.print(f"\n{title}", style="bold")
        for line in lines or ("  the same",):
            colour = {"-": "red", "+": "green"}.get(line[:1], "")
            console.print(line, style=colour)

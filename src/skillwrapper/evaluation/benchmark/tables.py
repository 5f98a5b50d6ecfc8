"""The tables of an experiment: what stands in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.benchmark.experiments import Experiment
from skillwrapper.evaluation.benchmark.figures import (
    Comparison,
    MethodFigures,
    Spread,
    compare,
    group_cells,
)
from skillwrapper.evaluation.benchmark.origins import Origin
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.published import PublishedMethod, PublishedResults

MAIN_METHOD: Final = "ours"
"""What the others are compared with, if it takes part."""

_EMBEDDED_NOTE = (
    "Made with the embedded model, a stand-in that sees simulated pictures; "
    "these are no figures of a real vision-language model."
)

# Title, and for each column its heading, its figure and the number of decimals.
_LAYOUTS: tuple[tuple[str, tuple[tuple[str, str, int], ...]], ...] = (
    (
        "Problems solved",
        (
            ("easy %", "easy", 1),
            ("budget", "budget_easy", 1),
            ("hard %", "hard", 1),
            ("budget", "budget_hard", 1),
            ("impossible %", "impossible", 1),
            ("falsely impossible %", "falsely_impossible", 1),
            ("length / optimal", "length_ratio", 2),
        ),
    ),
    (
        "The model, checked in every state",
        (
            ("precision", "precision", 3),
            ("recall", "recall", 3),
            ("effect accuracy", "effect_accuracy", 3),
            ("sound %", "sound", 0),
            ("complete %", "complete", 0),
            ("suitable %", "suitable", 0),
            ("predicates", "predicates", 1),
            ("operators", "operators", 1),
        ),
    ),
    (
        "The certificate, on the recorded data",
        (
            ("Lemma 1 violations", "lemma1_violations", 1),
            ("Theorem 1 violations", "theorem1_violations", 1),
            ("inconsistencies", "inconsistencies", 1),
            ("unresolved", "unresolved", 1),
        ),
    ),
    (
        "Exploration and learning",
        (
            ("executions", "learning_executions", 0),
            ("successes", "learning_successes", 0),
            ("model calls", "learning_calls", 0),
            ("cost, $", "learning_cost", 2),
            ("time, s", "learning_seconds", 0),
            ("area under recall", "area", 3),
            ("changed the model", "changing", 3),
            ("pairs covered", "pairs_covered", 3),
        ),
    ),
    (
        "Solving all problems",
        (
            ("executions", "executions", 0),
            ("successes", "successes", 0),
            ("model calls", "calls", 0),
            ("cost, $", "cost", 2),
            ("planning easy, s", "planning_easy", 3),
            ("planning hard, s", "planning_hard", 3),
            ("planning impossible, s", "planning_impossible", 3),
            ("solving, s", "solving_seconds", 0),
            ("whole cell, s", "seconds", 0),
        ),
    ),
)


@dataclass(frozen=True)
class Table:
    """A table of texts.

    Attributes:
        title: what it shows.
        headings: of the columns.
        rows: as many texts as headings each.
        note: what must be said with it; may be empty.
    """

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


@dataclass(frozen=True)
class Report:
    """All figures of an experiment.

    Attributes:
        experiment: what was asked for.
        finished: number of finished cells.
        methods: figures of every method, by domain and noise, in the order of tables.
        comparisons: of every method with the main one.
        origins: the commands that ran the cells.
        published: what others published, by domain.
    """

    experiment: Experiment
    finished: int
    methods: tuple[MethodFigures, ...]
    comparisons: tuple[Comparison, ...]
    origins: tuple[Origin, ...] = ()
    published: Mapping[str, PublishedResults] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        experiment: Experiment,
        cells: Sequence[CellResult],
        origins: Sequence[Origin] = (),
        published: Mapping[str, PublishedResults] | None = None,
    ) -> Report:
        """Put the report of the finished cells together."""
        methods: list[MethodFigures] = []
        comparisons: list[Comparison] = []
        for by_method in group_cells(cells).values():
            names = [name for name in METHODS if name in by_method]
            methods += [MethodFigures.of(by_method[name]) for name in names]
            main = MAIN_METHOD if MAIN_METHOD in names else names[0]
            comparisons += [
                compare(by_method[main], by_method[name]) for name in names if name != main
            ]
        return cls(
            experiment,
            len(cells),
            tuple(methods),
            tuple(comparisons),
            tuple(origins),
            published or {},
        )

    @property
    def note(self) -> str:
        """What must be said with the figures."""
        cells = f"{self.finished} of {len(self.experiment.cells)} cells are finished."
        return (
            f"{cells} {_EMBEDDED_NOTE}" if self.experiment.settings.model == "embedded" else cells
        )

    @property
    def made(self) -> tuple[tuple[str, str], ...]:
        """How the figures were made: what, in words, by what."""
        asked, settings, chosen = (
            self.experiment,
            self.experiment.settings,
            self.experiment.problems,
        )
        commands = dict.fromkeys(f"`{origin.command}`" for origin in self.origins)
        codes = dict.fromkeys(origin.code for origin in self.origins)
        return (
            *(("Command", command) for command in commands),
            *(("Code", code) for code in codes),
            ("Seeds", ", ".join(map(str, asked.seeds))),
            ("Model", settings.model),
            ("Noise", ", ".join(asked.noise)),
            ("Learning", f"{settings.iterations} iterations of {settings.budget} executions"),
            (
                "Problems",
                f"at most {chosen.easy} easy, {chosen.hard} hard, {chosen.impossible} impossible",
            ),
            ("Planning", f"at most {settings.time_limit:g} s a problem"),
        )

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "experiment": self.experiment.name,
            "note": self.note,
            "made": [list(pair) for pair in self.made],
            "cells": len(self.experiment.cells),
            "finished": self.finished,
            "methods": [method.to_json() for method in self.methods],
            "comparisons": [comparison.to_json() for comparison in self.comparisons],
        }

    def tables(self) -> tuple[Table, ...]:
        """The tables, those of one domain and noise together."""
        found = []
        for group in dict.fromkeys((m.domain, m.noise) for m in self.methods):
            mine = [m for m in self.methods if (m.domain, m.noise) == group]
            where = f"{group[0]}, noise {group[1]}"
            tables = [_figures(f"{title} ({where})", mine, layout) for title, layout in _LAYOUTS]
            published = self.published.get(group[0], PublishedResults())
            found += [tables[0], _beside_published(where, mine, published), *tables[1:]]
            found.append(_causes(where, mine))
            theirs = [c for c in self.comparisons if (c.domain, c.noise) == group]
            found.append(_comparisons(where, theirs))
        return tuple(table for table in found if table.rows)


def _figures(
    title: str, methods: Sequence[MethodFigures], layout: Sequence[tuple[str, str, int]]
) -> Table:
    """A table without the methods that have none of its figures."""
    rows = tuple(
        (_title(m.method), *(_figure(m, name, decimals) for _, name, decimals in layout))
        for m in methods
        if any(m.figures[name] is not None for _, name, _ in layout)
    )
    return Table(title, ("method", *(heading for heading, _, _ in layout)), rows)


def _beside_published(
    where: str, methods: Sequence[MethodFigures], published: PublishedResults
) -> Table:
    """Our figures and the paper's, of the methods that are in both."""
    names = tuple(PublishedMethod.model_fields)
    rows = []
    for method in methods:
        row = published.methods.get(method.method)
        if row is not None:
            pairs = ((_figure(method, name, 1), _published(getattr(row, name))) for name in names)
            rows.append((_title(method.method), *(text for pair in pairs for text in pair)))
    headings = ("easy %", "budget", "hard %", "budget", "impossible %")
    columns = ("method", *(text for heading in headings for text in (heading, "paper")))
    return Table(f"Beside the paper ({where})", columns, tuple(rows), published.note)


def _published(figure: tuple[float, float] | None) -> str:
    return "-" if figure is None else f"{figure[0]:.1f} ± {figure[1]:.1f}"


def _causes(where: str, methods: Sequence[MethodFigures]) -> Table:
    causes = sorted({cause for m in methods for cause in m.causes})
    rows = tuple(
        (_title(m.method), *(str(m.causes.get(cause, 0)) for cause in causes))
        for m in methods
        if m.causes
    )
    title = f"Why problems were not solved, over all seeds ({where})"
    return Table(title, ("method", *causes), rows)


def _comparisons(where: str, comparisons: Sequence[Comparison]) -> Table:
    rows = tuple(
        (
            f"{_title(c.method)} - {_title(c.other)}",
            _show(c.difference, 1),
            str(c.wins),
            str(c.losses),
            f"{c.p_value:.3g}",
        )
        for c in comparisons
    )
    headings = ("methods", "difference, %", "only the first", "only the second", "p (McNemar)")
    return Table(f"Same problems, same seeds ({where})", headings, rows)


def _figure(method: MethodFigures, name: str, decimals: int) -> str:
    return "unknown" if method.is_unknown(name) else _show(method.figures[name], decimals)


def _show(spread: Spread | None, decimals: int) -> str:
    if spread is None:
        return "-"
    mean = f"{spread.mean:.{decimals}f}"
    return mean if spread.count < 2 else f"{mean} ± {spread.std:.{decimals}f}"


def _title(method: str) -> str:
    return METHODS[method].title

"""All figures of an experiment together, and how they were made."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.benchmark.comparisons import PairedComparison, compare
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import CommandRecord, Experiment
from skillwrapper.evaluation.benchmark.figures import MethodFigures, group_cells
from skillwrapper.evaluation.benchmark.tables import Table, group_tables
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.published import PublishedResults
from skillwrapper.runs.models import EMBEDDED

MAIN_METHOD: Final = "ours"
"""What the others are compared with, if it takes part."""

_EMBEDDED_NOTE = (
    "Made with the embedded model, a stand-in that sees simulated pictures; "
    "these are no figures of a real vision-language model."
)


@dataclass(frozen=True)
class ExperimentSummary:
    """All figures of an experiment.

    Attributes:
        experiment: what was asked for.
        finished: number of finished cells.
        methods: figures of every method, by domain and noise, in the order of tables.
        comparisons: of every method with the main one.
        commands: the commands that ran the cells.
        published: what others published, by domain.
        failures: why cells failed, by their names.
    """

    experiment: Experiment
    finished: int
    methods: tuple[MethodFigures, ...]
    comparisons: tuple[PairedComparison, ...]
    commands: tuple[CommandRecord, ...] = ()
    published: Mapping[str, PublishedResults] = field(default_factory=dict)
    failures: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        experiment: Experiment,
        cells: Sequence[CellResult],
        commands: Sequence[CommandRecord] = (),
        published: Mapping[str, PublishedResults] | None = None,
        failures: Mapping[str, str] | None = None,
    ) -> ExperimentSummary:
        """Put the figures of the finished cells together."""
        methods: list[MethodFigures] = []
        comparisons: list[PairedComparison] = []
        embedded = experiment.settings.model.name == EMBEDDED
        for by_method in group_cells(cells).values():
            names = [name for name in METHODS if name in by_method]
            methods += [MethodFigures.of(by_method[name]) for name in names]
            main = MAIN_METHOD if MAIN_METHOD in names else names[0]
            for name in names:
                if name != main:
                    decided = any(METHODS[n].shares.decided_by_model for n in (main, name))
                    testable = not (embedded and decided)
                    pair = (by_method[main], by_method[name])
                    comparisons.append(compare(*pair, testable=testable))
        return cls(
            experiment,
            len(cells),
            tuple(methods),
            tuple(comparisons),
            tuple(commands),
            published or {},
            failures or {},
        )

    @property
    def note(self) -> str:
        """What must be said with the figures."""
        cells = f"{self.finished} of {len(self.experiment.cells)} cells are finished."
        embedded = self.experiment.settings.model.name == EMBEDDED
        return f"{cells} {_EMBEDDED_NOTE}" if embedded else cells

    @property
    def made(self) -> tuple[tuple[str, str], ...]:
        """How the figures were made: what, in words, by what."""
        asked, settings, chosen = (
            self.experiment,
            self.experiment.settings,
            self.experiment.problems,
        )
        commands = dict.fromkeys(f"`{record.command}`" for record in self.commands)
        codes = dict.fromkeys(record.code for record in self.commands)
        return (
            *(("Command", command) for command in commands),
            *(("Code", code) for code in codes),
            *(("Not run", f"{cell}: {reason}") for cell, reason in self.failures.items()),
            ("Seeds", ", ".join(map(str, asked.seeds))),
            ("Model", settings.model.name),
            ("Noise", ", ".join(asked.noise)),
            (
                "Learning",
                f"{settings.iterations} iterations of {settings.exploration.budget} executions",
            ),
            (
                "Problems",
                f"at most {chosen.easy} easy, {chosen.hard} hard, {chosen.impossible} impossible",
            ),
            ("Planning", f"at most {settings.planner.time_limit:g} s a problem"),
            ("Readings", settings.readings),
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
        found: list[Table] = []
        for domain, noise in dict.fromkeys((m.domain, m.noise) for m in self.methods):
            found += self.tables_of(domain, noise)
        return tuple(found)

    def tables_of(self, domain: str, noise: str) -> tuple[Table, ...]:
        """The tables of one domain with one noise."""
        mine = [m for m in self.methods if (m.domain, m.noise) == (domain, noise)]
        theirs = [c for c in self.comparisons if (c.domain, c.noise) == (domain, noise)]
        published = self.published.get(domain, PublishedResults())
        return group_tables(domain, noise, mine, theirs, published)


def summarise(folder: ExperimentFolder) -> ExperimentSummary:
    """All figures of the finished cells in a folder.

    Raises:
        RunFolderError: if a file is damaged.
    """
    return ExperimentSummary.of(
        folder.experiment(),
        tuple(folder.results()),
        folder.runs(),
        folder.published(),
        folder.failures(),
    )

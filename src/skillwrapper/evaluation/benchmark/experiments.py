"""An experiment: which methods, on what, how often, and with what errors of perception."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Final

from pydantic import BaseModel, ConfigDict, Field, field_validator

from skillwrapper.domains.discovery import plain_names
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.world.domain_file import Prose

MOST_SEEDS: Final = 1_000
MOST_CELLS: Final = 10_000
"""More are a slip of the pen: each cell is a run, with a folder of its own."""

_Seed = Annotated[int, Field(ge=0, strict=True)]


class ProblemChoice(BaseModel):
    """Which problems are solved.

    Attributes:
        file: a problem file, beside the experiment file; None for the domain's shipped one.
        easy: how many easy ones at most, the first of the file.
        hard: likewise.
        impossible: likewise.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    file: str | None = None
    easy: int = Field(default=20, ge=0)
    hard: int = Field(default=20, ge=0)
    impossible: int = Field(default=10, ge=0)


class Experiment(BaseModel):
    """A comparison of methods.

    Attributes:
        name: of the experiment.
        description: what it is to show.
        methods: names of methods, in any order.
        domains: references to domains; by default all bundled ones that need no extra.
        seeds: every method runs once with each; at most ``MOST_SEEDS``.
        noise: profiles of the embedded model (``none``, ``gpt5``), or rates from 0 to 1 with
            which every judgement errs.
        settings: what is equal in all cells.
        problems: what is to be solved.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = Field(pattern=r"^[A-Za-z0-9][\w-]*$")
    description: Prose = ""
    methods: tuple[str, ...] = Field(min_length=1)
    domains: tuple[str, ...] = Field(default_factory=plain_names, min_length=1)
    seeds: tuple[_Seed, ...] = Field(default=(0,), min_length=1, max_length=MOST_SEEDS)
    noise: tuple[str, ...] = Field(default=("none",), min_length=1)
    settings: ExperimentSettings = Field(default_factory=ExperimentSettings)
    problems: ProblemChoice = Field(default_factory=ProblemChoice)

    @field_validator("noise", mode="before")
    @classmethod
    def _rates_as_names(cls, given: object) -> object:
        """YAML reads rates as numbers; no errors at all is the profile ``none``."""
        if not isinstance(given, list | tuple):
            return given
        return [_noise_name(value) if isinstance(value, int | float) else value for value in given]

    @property
    def cell_count(self) -> int:
        """How many cells there are."""
        return len(self.noise) * len(self.domains) * len(self.seeds) * len(self.methods)

    @property
    def cells(self) -> tuple[Cell, ...]:
        """All cells, a seed of all methods after the other; cells that others need come first."""
        methods = sorted(self.methods, key=lambda name: METHODS[name].source is not None)
        return tuple(
            Cell(method, domain, seed, noise)
            for noise in self.noise
            for domain in self.domains
            for seed in self.seeds
            for method in methods
        )

    def source_of(self, cell: Cell) -> Cell | None:
        """The cell whose recorded data another one learns from."""
        source = METHODS[cell.method].source
        return None if source is None else Cell(source, cell.domain, cell.seed, cell.noise)


def _noise_name(rate: float) -> str:
    return f"{rate:g}" if rate else "none"


@dataclass(frozen=True)
class CommandRecord:
    """A command that ran cells of an experiment.

    Attributes:
        command: as it was given.
        made_with: versions and commit, as ``runs.provenance`` tells them.
    """

    command: str
    made_with: Mapping[str, Any]

    @property
    def code(self) -> str:
        """Version and commit in words."""
        made = self.made_with
        commit = made.get("commit")
        where = f"commit {commit[:12]}" if commit else "no commit known"
        changed = " with uncommitted changes" if made.get("changed") else ""
        packages = made.get("packages") or {}
        versions = [f"Python {made.get('python')}", *(f"{n} {v}" for n, v in packages.items() if v)]
        return f"skillwrapper {made.get('skillwrapper')}, {where}{changed} ({', '.join(versions)})"

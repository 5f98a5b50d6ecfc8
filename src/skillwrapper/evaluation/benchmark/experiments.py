"""Experiments as files: which methods, on what, how often, and with what errors of perception."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, field_validator

from skillwrapper.domains.discovery import bundled_names, find_domain
from skillwrapper.embedded.noise import noise_profile, profile_names
from skillwrapper.errors import ConfigurationError, UnknownNameError, UserError
from skillwrapper.evaluation.methods.method import Cell, CellSettings
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.files.yaml_documents import YamlDocument


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
        domains: references to domains; by default all bundled ones.
        seeds: every method runs once with each.
        noise: profiles of the embedded model (``none``, ``gpt5``), or rates from 0 to 1 with
            which every judgement errs.
        settings: what is equal in all cells.
        problems: what is to be solved.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = Field(pattern=r"^[A-Za-z0-9][\w-]*$")
    description: str = ""
    methods: tuple[str, ...] = Field(min_length=1)
    domains: tuple[str, ...] = Field(default_factory=bundled_names, min_length=1)
    seeds: tuple[int, ...] = Field(default=(0,), min_length=1)
    noise: tuple[str, ...] = Field(default=("none",), min_length=1)
    settings: CellSettings = Field(default_factory=CellSettings)
    problems: ProblemChoice = Field(default_factory=ProblemChoice)

    @field_validator("noise", mode="before")
    @classmethod
    def _rates_as_names(cls, given: object) -> object:
        """YAML reads rates as numbers; no errors at all is the profile ``none``."""
        if not isinstance(given, list | tuple):
            return given
        return [_noise_name(value) if isinstance(value, int | float) else value for value in given]

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


def read_experiment(path: Path) -> Experiment:
    """Read an experiment file.

    Raises:
        ConfigurationError: with file, line, what was expected and what came.
        UnknownNameError: for a method, domain or noise that does not exist, with the nearest one.
    """
    document = YamlDocument.read(path)
    experiment = document.validate(Experiment)
    _check_names(document, "methods", "method", experiment.methods, METHODS)
    for number, domain in enumerate(experiment.domains):
        _check_domain(domain, document.place(("domains", number)))
    for key in ("methods", "domains", "seeds", "noise"):
        _check_different(document, key, getattr(experiment, key))
    for number, name in enumerate(experiment.noise):
        try:
            noise_profile(name)
        except UnknownNameError as error:
            place = document.place(("noise", number))
            raise UnknownNameError("noise", name, profile_names(), place) from error
    _check_sources(document, experiment)
    return _with_problem_file(document, experiment)


def _check_names(
    document: YamlDocument, key: str, kind: str, names: tuple[str, ...], known: Collection[str]
) -> None:
    for number, name in enumerate(names):
        if name not in known:
            raise UnknownNameError(kind, name, known, document.place((key, number)))


def _check_domain(reference: str, where: str) -> None:
    try:
        find_domain(reference)
    except UserError as error:
        raise ConfigurationError(f"{where}: {error}") from error


def _check_different(document: YamlDocument, key: str, values: tuple[object, ...]) -> None:
    for number, value in enumerate(values):
        if value in values[:number]:
            where = document.place((key, number))
            raise ConfigurationError(f"{where}: expected different {key}, got {value!r} twice")


def _check_sources(document: YamlDocument, experiment: Experiment) -> None:
    for number, name in enumerate(experiment.methods):
        source = METHODS[name].source
        if source is not None and source not in experiment.methods:
            raise ConfigurationError(
                f"{document.place(('methods', number))}: '{name}' learns from what '{source}' "
                f"executes; expected '{source}' among the methods, add it"
            )


def _with_problem_file(document: YamlDocument, experiment: Experiment) -> Experiment:
    """The same with an absolute path, so that the folder of results can stand anywhere."""
    name = experiment.problems.file
    if name is None:
        return experiment
    path = (document.path.parent / name).resolve()
    where = document.place(("problems", "file"))
    if not path.is_file():
        raise ConfigurationError(f"{where}: expected a file of problems, found none at {path}")
    if len(experiment.domains) > 1:
        raise ConfigurationError(
            f"{where}: one file of problems is for one domain, got {len(experiment.domains)}"
        )
    problems = experiment.problems.model_copy(update={"file": str(path)})
    return experiment.model_copy(update={"problems": problems})

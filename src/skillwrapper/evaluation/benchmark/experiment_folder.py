"""The folder of an experiment's results.

experiment.yaml         what was asked for, with versions and commit
problems/<domain>.yaml  the problems that are solved
runs.jsonl              every command that ran cells, with versions and commit
cells/<cell>/           result.json, problems.jsonl, run/ (like any other run), error.txt
truth/                  labels of predicates in all states, shared by all cells
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

import yaml

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import RunFolderError
from skillwrapper.evaluation.benchmark.cell_records import RunLine
from skillwrapper.evaluation.benchmark.cells import RESULT, CellResult
from skillwrapper.evaluation.benchmark.experiments import CommandRecord, Experiment
from skillwrapper.evaluation.methods.cell import Cell, domain_key
from skillwrapper.evaluation.problems.problem_files import read_problems, write_problems
from skillwrapper.evaluation.problems.problems import ProblemSet
from skillwrapper.evaluation.published import PublishedResults, published_figures
from skillwrapper.files.json_documents import read_records
from skillwrapper.files.locking import locked
from skillwrapper.files.writing import append_line, is_leftover, remove_leftovers, write_atomically
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.redaction import without_secrets
from skillwrapper.runs.provenance import provenance

ERROR = "error.txt"
"""Why a cell failed, in its folder; gone once it succeeds."""

_EXPERIMENT = "experiment.yaml"
_RUNS = "runs.jsonl"


@dataclass(frozen=True)
class ExperimentFolder:
    """The folder of one experiment.

    Attributes:
        path: where it is.
    """

    path: Path

    @classmethod
    def create_or_resume(cls, path: Path, experiment: Experiment) -> ExperimentFolder:
        """A new folder, or the folder of the same experiment.

        Raises:
            RunFolderError: if the path holds something else, or another experiment.
        """
        folder = cls(path)
        sets = {name: _choose(experiment, name) for name in experiment.domains}
        if cls.is_one(path):
            folder._compare(experiment, sets)
        else:
            _check_empty(path)
            made_with = provenance().model_dump(mode="json")
            content = {"experiment": experiment.model_dump(mode="json"), "made_with": made_with}
            write_atomically(path / _EXPERIMENT, yaml.safe_dump(content, sort_keys=False))
        for name, problems in sets.items():
            if problems.problems and not folder.problem_file(name).exists():
                write_problems(problems, folder.problem_file(name))
        return folder

    @classmethod
    def open(cls, path: Path) -> ExperimentFolder:
        """The folder of an existing experiment.

        Raises:
            RunFolderError: if there is none.
        """
        if not cls.is_one(path):
            raise RunFolderError(
                f"{path}: expected the folder of an experiment (with {_EXPERIMENT}); "
                "make one with: skillwrapper experiment run FILE --out DIR"
            )
        return cls(path)

    @staticmethod
    def is_one(path: Path) -> bool:
        """Whether a path is the folder of an experiment."""
        return (path / _EXPERIMENT).is_file()

    def experiment(self) -> Experiment:
        """What was asked for.

        Raises:
            ConfigurationError: if the file was damaged.
        """
        return YamlDocument.read(self.path / _EXPERIMENT).part("experiment").validate(Experiment)

    def note_run(self, command: str) -> None:
        """Note that a command runs what is not finished yet, and with which code."""
        if any(not self.is_finished(cell) for cell in self.experiment().cells):
            made_with = provenance().model_dump(mode="json")
            line = {"command": without_secrets(command), "made_with": made_with}
            append_line(self.path / _RUNS, line)

    def runs(self) -> tuple[CommandRecord, ...]:
        """The commands that ran cells, in order of time."""
        lines = read_records(self.path / _RUNS, RunLine)
        return tuple(CommandRecord(line.command, line.made_with.model_dump()) for line in lines)

    def published(self) -> dict[str, PublishedResults]:
        """What others published of the domains, for the same methods."""
        return {
            name: published_figures(find_domain(name)).results for name in self.experiment().domains
        }

    def problem_file(self, domain: str) -> Path:
        """Where the problems of a domain stand."""
        return self.path / "problems" / f"{domain_key(domain)}.yaml"

    def problems(self, domain: str) -> ProblemSet:
        """The problems of a domain; an empty set if there are none."""
        package = find_domain(domain)
        if not self.problem_file(domain).exists():
            return ProblemSet(package.domain.name, 0, ())
        with closing(package.make_environment()) as environment:
            return read_problems(self.problem_file(domain), environment)

    def cell(self, cell: Cell) -> Path:
        """The folder of a cell."""
        return self.path / "cells" / cell.name

    @property
    def truth(self) -> Path:
        """Where labels of all states are kept."""
        return self.path / "truth"

    def is_finished(self, cell: Cell) -> bool:
        """Whether a cell has its result."""
        return (self.cell(cell) / RESULT).is_file()

    def failures(self) -> dict[str, str]:
        """Why cells failed that are not finished, in one line each, by their names."""
        cells = (cell for cell in self.experiment().cells if not self.is_finished(cell))
        files = {cell.name: self.cell(cell) / ERROR for cell in cells}
        return {
            name: file.read_text(encoding="utf-8", errors="replace").partition("\n")[0]
            for name, file in files.items()
            if file.is_file()
        }

    def results(self) -> Iterator[CellResult]:
        """The results of all finished cells, in the order of the experiment."""
        for cell in self.experiment().cells:
            if self.is_finished(cell):
                yield CellResult.read(self.cell(cell))

    @contextmanager
    def reserved(self) -> Iterator[None]:
        """Keep others from running the same experiment here; ends with the process at the latest.

        What a crash left of writing files is removed.

        Raises:
            RunFolderError: if another process is at it.
        """
        busy = (
            f"{self.path}: another process is running this experiment; wait for it, "
            "or choose another --out"
        )
        with locked(self.path, busy):
            remove_leftovers(self.path)
            yield

    def _compare(self, experiment: Experiment, sets: dict[str, ProblemSet]) -> None:
        mine = self.experiment().model_dump(mode="json")
        theirs = experiment.model_dump(mode="json")
        differing = [key for key in mine if mine[key] != theirs[key]]
        differing = [key for key in differing if key not in {"name", "description"}]
        if differing:
            key = differing[0]
            raise RunFolderError(
                f"{self.path / _EXPERIMENT} holds another experiment ({key}: {mine[key]!r} there, "
                f"{theirs[key]!r} now); choose another --out"
            )
        for name, problems in sets.items():
            if self.problem_file(name).exists() and self.problems(name) != problems:
                raise RunFolderError(
                    f"{self.problem_file(name)} is of another experiment (other problems of "
                    f"{name}); choose another --out"
                )


def _check_empty(path: Path) -> None:
    """What a crash left of writing the first file does not count."""
    if path.exists() and (not path.is_dir() or any(not is_leftover(p) for p in path.iterdir())):
        raise RunFolderError(
            f"{path} is not empty and holds no experiment; choose another --out, "
            "nothing was changed"
        )


def _choose(experiment: Experiment, domain: str) -> ProblemSet:
    choice, package = experiment.problems, find_domain(domain)
    if not (choice.file or package.has("problems")):
        return ProblemSet(package.domain.name, 0, ())
    path = Path(choice.file) if choice.file else package.problems
    with closing(package.make_environment()) as environment:
        problems = read_problems(path, environment)
    return problems.first(choice.easy, choice.hard, choice.impossible)

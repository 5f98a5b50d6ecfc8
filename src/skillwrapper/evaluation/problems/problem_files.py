"""Problem files: what stands in them, and how every mistake in them is told with its line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import yaml
from pydantic import AliasChoices, BaseModel, ConfigDict, Field, model_validator

from skillwrapper.errors import ConfigurationError, UnknownNameError, UserError
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass, ProblemSet
from skillwrapper.files.writing import write_atomically
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.planning.goal_text import read_group
from skillwrapper.world.capabilities import Judged, Settable, require
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import load_picture

_PICTURES: Final = "pictures"
"""The folder beside a written problem file with the pictures of its goals."""


def write_problems(problems: ProblemSet, path: Path) -> None:
    """Write a problem file, with the pictures of goals beside it.

    Raises:
        FileError: if a file cannot be written.
    """
    for problem in problems.problems:
        if problem.goal_picture is not None:
            write_atomically(path.parent / _name(problem.goal_picture), problem.goal_picture.png)
    text = yaml.safe_dump(
        problems_data(problems), sort_keys=False, default_flow_style=None, width=100
    )
    write_atomically(path, text)


def problems_data(problems: ProblemSet) -> dict[str, Any]:
    """Plain data, as in a problem file."""
    entries = [_problem_data(problem) for problem in problems.problems]
    return {"domain": problems.domain, "seed": problems.seed, "problems": entries}


def _problem_data(problem: Problem) -> dict[str, Any]:
    picture = problem.goal_picture
    entry = {
        "name": problem.name,
        "class": str(problem.kind),
        "reason": problem.reason or None,
        "length": problem.length,
        "scene": problem.scene,
        "layout": problem.layout,
        "initial": _plain(problem.initial),
        "goal": _plain(problem.goal),
        "goal_picture": _name(picture) if picture else None,
        "goal_literals": problem.goal_literals or None,
        "goal_test": problem.goal_test or None,
    }
    return {key: value for key, value in entry.items() if value is not None}


def _plain(state: Mapping[str, Any] | None) -> dict[str, Any] | None:
    return None if state is None else dict(state)


def _name(picture: Picture) -> str:
    return f"{_PICTURES}/{picture.sha256}.png"


class _ProblemEntry(BaseModel):
    model_config = ConfigDict(extra="forbid")
    name: str = Field(min_length=1)
    kind: ProblemClass = Field(alias="class")
    length: int | None = Field(default=None, ge=0)
    reason: str = ""
    scene: str | None = None
    layout: int = Field(ge=0, validation_alias=AliasChoices("layout", "seed"))
    initial: dict[str, Any] | None = None
    goal: dict[str, Any] | None = None
    goal_picture: str | None = None
    goal_literals: str = ""
    goal_test: str = ""

    @model_validator(mode="after")
    def _length_or_reason(self) -> _ProblemEntry:
        impossible = self.kind is ProblemClass.IMPOSSIBLE
        if impossible and (self.length is not None or not self.reason):
            raise ValueError(
                "expected a reason and no length for a problem of the class impossible"
            )
        if not impossible and self.reason:
            raise ValueError(f"expected no reason for a problem of the class {self.kind}")
        return self

    @model_validator(mode="after")
    def _some_goal(self) -> _ProblemEntry:
        if self.goal is None and self.goal_picture is None and not self.goal_literals:
            raise ValueError(
                "expected what is wanted: a state as 'goal', a 'goal_picture' or 'goal_literals'"
            )
        return self


class _ProblemFile(BaseModel):
    model_config = ConfigDict(extra="forbid")
    domain: str
    seed: int = 0
    problems: list[_ProblemEntry] = Field(min_length=1)


def read_problems(path: Path, environment: Environment) -> ProblemSet:
    """Read a problem file.

    Args:
        path: the file.
        environment: the domain, which says whether states are states and tests are tests.

    Raises:
        ConfigurationError: with file, line, what was expected and what came; quotes nothing of a
            file that is no file of problems.
        UnknownNameError: if there is no such scene or test.
    """
    document = read_problem_document(path)
    entries = document.validate(_ProblemFile)
    if entries.domain != environment.domain.name:
        raise ConfigurationError(
            f"{document.place(('domain',))}: expected problems of {environment.domain.name}, "
            f"got problems of {entries.domain}; give another file of problems"
        )
    _check_names(document, entries)
    problems = tuple(
        _Checker(document, environment, number).problem(entry)
        for number, entry in enumerate(entries.problems)
    )
    return ProblemSet(entries.domain, entries.seed, problems)


def read_problem_document(path: Path) -> YamlDocument:
    """The YAML of a problem file.

    Raises:
        ConfigurationError: if it is something else, of which nothing is quoted.
    """
    if path.suffix not in {".yaml", ".yml"}:
        raise ConfigurationError(f"{path}: expected a YAML file of problems, by its ending .yaml")
    document = YamlDocument.read(path)
    data = document.data
    if not (isinstance(data, dict) and {"domain", "problems"} <= set(data)):
        raise ConfigurationError(
            f"{path}: expected a file of problems, with 'domain' and 'problems', got another file"
        )
    return document


@dataclass(frozen=True)
class _Checker:
    """Checks one entry against its domain."""

    document: YamlDocument
    environment: Environment
    number: int

    def problem(self, entry: _ProblemEntry) -> Problem:
        scenes = self.environment.domain.scenes
        if entry.scene is not None and entry.scene not in scenes:
            raise UnknownNameError("scene", entry.scene, scenes, self._place("scene"))
        for key in ("initial", "goal"):
            self._check_state(key, getattr(entry, key))
        self._check_literals(entry.goal_literals)
        self._check_test(entry.goal_test)
        return Problem(
            name=entry.name,
            kind=entry.kind,
            layout=entry.layout,
            initial=entry.initial,
            goal=entry.goal,
            length=entry.length,
            reason=entry.reason,
            scene=entry.scene,
            goal_picture=self._picture(entry.goal_picture),
            goal_literals=entry.goal_literals,
            goal_test=entry.goal_test,
        )

    def _check_state(self, key: str, data: dict[str, Any] | None) -> None:
        if data is None:
            return
        try:
            require(self.environment, Settable, f"'{key}' as a state").state_from_data(data)
        except ConfigurationError as error:
            raise ConfigurationError(f"{self._place(key)}: {error}") from error

    def _check_literals(self, text: str) -> None:
        try:
            read_group(text)
        except UserError as error:
            raise ConfigurationError(f"{self._place('goal_literals')}: {error}") from error

    def _check_test(self, name: str) -> None:
        if not name:
            return
        where = self._place("goal_test")
        try:
            known = require(self.environment, Judged, "'goal_test'").goals
        except ConfigurationError as error:
            raise ConfigurationError(f"{where}: {error}") from error
        if name not in known:
            raise UnknownNameError("test", name, known, where)

    def _picture(self, name: str | None) -> Picture | None:
        if name is None:
            return None
        try:
            return load_picture(self.document.path.parent / name)
        except UserError as error:
            raise ConfigurationError(f"{self._place('goal_picture')}: {error}") from error

    def _place(self, key: str) -> str:
        return self.document.place(("problems", self.number, key))


def _check_names(document: YamlDocument, entries: _ProblemFile) -> None:
    names = [entry.name for entry in entries.problems]
    for number, name in enumerate(names):
        if name in names[:number]:
            where = document.place(("problems", number, "name"))
            raise ConfigurationError(f"{where}: expected different names, got '{name}' twice")

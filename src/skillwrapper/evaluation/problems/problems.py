"""Test problems: from one true state to another, as data."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import yaml
from pydantic import BaseModel, ConfigDict, Field, model_validator

from skillwrapper.errors import ConfigurationError
from skillwrapper.files.writing import write_atomically
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.world.capabilities import Enumerable

LONGEST_EASY = 7
LONGEST_HARD = 15
"""Optimal lengths up to which problems count as easy and hard (paper, Section 4.1)."""


class ProblemClass(StrEnum):
    """How difficult a problem is."""

    EASY = "easy"
    """An optimal solution has 1 to 7 skills."""
    HARD = "hard"
    """An optimal solution has 8 to 15 skills."""
    IMPOSSIBLE = "impossible"
    """No sequence of skills leads to the goal."""


@dataclass(frozen=True)
class Problem:
    """One problem; its two pictures are drawn when they are needed.

    Attributes:
        name: unique in its set.
        kind: how difficult it is.
        layout: the seed of the layout of both pictures.
        initial: the state to start from, as plain data of the domain.
        goal: the state to reach, as plain data of the domain.
        length: number of skills of an optimal solution; None if there is none.
        reason: why it is impossible; empty if it is not.
    """

    name: str
    kind: ProblemClass
    layout: int
    initial: dict[str, Any]
    goal: dict[str, Any]
    length: int | None = None
    reason: str = ""

    def to_data(self) -> dict[str, Any]:
        """The entry of a problem file."""
        entry: dict[str, Any] = {"name": self.name, "class": str(self.kind)}
        entry |= {"reason": self.reason} if self.length is None else {"length": self.length}
        return {**entry, "layout": self.layout, "initial": self.initial, "goal": self.goal}


@dataclass(frozen=True)
class ProblemSet:
    """Problems of one domain.

    Attributes:
        domain: name of the domain.
        seed: the seed they were made with.
        problems: the problems.
    """

    domain: str
    seed: int
    problems: tuple[Problem, ...]

    def of(self, kind: ProblemClass) -> tuple[Problem, ...]:
        """The problems of a class."""
        return tuple(p for p in self.problems if p.kind is kind)

    def first(self, easy: int, hard: int, impossible: int) -> ProblemSet:
        """At most so many problems of each class, the first ones of the set."""
        wanted = zip(ProblemClass, (easy, hard, impossible), strict=True)
        chosen = tuple(p for kind, count in wanted for p in self.of(kind)[:count])
        return ProblemSet(self.domain, self.seed, chosen)

    def to_data(self) -> dict[str, Any]:
        """Plain data, as in a problem file."""
        problems = [p.to_data() for p in self.problems]
        return {"domain": self.domain, "seed": self.seed, "problems": problems}

    def write(self, path: Path) -> None:
        """Write a problem file."""
        text = yaml.safe_dump(self.to_data(), sort_keys=False, default_flow_style=None, width=100)
        write_atomically(path, text)


class _ProblemEntry(BaseModel):
    model_config = ConfigDict(extra="forbid")
    name: str = Field(min_length=1)
    kind: ProblemClass = Field(alias="class")
    length: int | None = Field(default=None, ge=0)
    reason: str = ""
    layout: int = Field(ge=0)
    initial: dict[str, Any]
    goal: dict[str, Any]

    @model_validator(mode="after")
    def _length_or_reason(self) -> _ProblemEntry:
        impossible = self.kind is ProblemClass.IMPOSSIBLE
        if impossible != (self.length is None) or impossible != bool(self.reason):
            expected = "a reason and no length" if impossible else "a length and no reason"
            raise ValueError(f"expected {expected} for a problem of the class {self.kind}")
        return self


class _ProblemFile(BaseModel):
    model_config = ConfigDict(extra="forbid")
    domain: str
    seed: int = 0
    problems: list[_ProblemEntry] = Field(min_length=1)


def read_problems(path: Path, environment: Enumerable) -> ProblemSet:
    """Read a problem file.

    Args:
        path: the file.
        environment: the domain, which says whether the states are states.

    Raises:
        ConfigurationError: with file, line, what was expected and what came.
    """
    document = YamlDocument.read(path)
    entries = document.validate(_ProblemFile)
    if entries.domain != environment.domain.name:
        raise ConfigurationError(
            f"{document.place(('domain',))}: expected problems of {environment.domain.name}, "
            f"got problems of {entries.domain}; give another file of problems"
        )
    _check_names(document, entries)
    for number, entry in enumerate(entries.problems):
        for key in ("initial", "goal"):
            try:
                environment.state_from_data(getattr(entry, key))
            except ConfigurationError as error:
                where = document.place(("problems", number, key))
                raise ConfigurationError(f"{where}: {error}") from error
    problems = tuple(
        Problem(e.name, e.kind, e.layout, e.initial, e.goal, e.length, e.reason)
        for e in entries.problems
    )
    return ProblemSet(entries.domain, entries.seed, problems)


def _check_names(document: YamlDocument, entries: _ProblemFile) -> None:
    names = [entry.name for entry in entries.problems]
    for number, name in enumerate(names):
        if name in names[:number]:
            where = document.place(("problems", number, "name"))
            raise ConfigurationError(f"{where}: expected different names, got '{name}' twice")

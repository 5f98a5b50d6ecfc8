"""What a run recorded, iteration by iteration, as the report needs it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from skillwrapper.errors import RunFolderError
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.recorder import read_episode
from skillwrapper.world.episode import Episode, Transition


@dataclass(frozen=True)
class Decision:
    """What was decided of a predicate.

    Attributes:
        iteration: when, from 1.
        verdict: accepted, revived, rejected, retracted or dormant.
        predicate: its signature.
        semantics: its meaning, may be empty.
        score: 0 to 1; None if there is none.
        reason: why.
        inconsistency: what it was asked for, as ``describe_inconsistency`` wrote it; None if for
            nothing.
    """

    iteration: int
    verdict: str
    predicate: str
    semantics: str
    score: float | None
    reason: str
    inconsistency: dict[str, Any] | None

    @property
    def name(self) -> str:
        """The name of the predicate, without its parameters."""
        return self.predicate.partition("(")[0]


@dataclass(frozen=True)
class Iteration:
    """One finished iteration.

    Attributes:
        number: from 1.
        episode: what was executed.
        decisions: what was decided, in order.
        summary: figures at its end.
    """

    number: int
    episode: Episode
    decisions: tuple[Decision, ...]
    summary: dict[str, Any]

    @property
    def executions(self) -> int:
        """How many skills were executed in this iteration."""
        return len(self.episode.transitions)

    @property
    def successes(self) -> int:
        """How many of them succeeded."""
        return sum(t.success for t in self.episode.transitions)

    @property
    def lasting(self) -> tuple[Decision, ...]:
        """The decisions that changed the vocabulary."""
        return tuple(d for d in self.decisions if d.verdict != "rejected")

    @property
    def rejected(self) -> tuple[Decision, ...]:
        """The candidates that were not taken."""
        return tuple(d for d in self.decisions if d.verdict == "rejected")


@dataclass(frozen=True)
class RunHistory:
    """All finished iterations of a run.

    Attributes:
        iterations: in order.
    """

    iterations: tuple[Iteration, ...]

    @classmethod
    def read(cls, folder: RunFolder) -> RunHistory:
        """Read what is finished.

        Raises:
            RunFolderError: if a file is missing or damaged.
        """
        numbers = range(1, folder.finished_iterations() + 1)
        return cls(tuple(_read_iteration(folder, number) for number in numbers))

    @cached_property
    def transitions(self) -> tuple[Transition, ...]:
        """All transitions; certificate and inconsistencies count them from 0."""
        return tuple(t for i in self.iterations for t in i.episode.transitions)

    @property
    def successes(self) -> int:
        """How many executions succeeded."""
        return sum(i.successes for i in self.iterations)

    def origin(self, signature: str) -> Decision | None:
        """The decision that last brought a predicate in, by signature or else by name.

        A predicate that was widened to another type (DESIGN.md D3) has kept its name only.
        """
        name = signature.partition("(")[0]
        brought = [d for d in self.decisions() if d.verdict in ("accepted", "revived")]
        exact = [d for d in brought if d.predicate == signature and d.inconsistency]
        named = [d for d in brought if d.name == name and d.inconsistency]
        fitting = exact or named
        return fitting[-1] if fitting else None

    def decisions(self) -> Iterator[Decision]:
        """All decisions in order of time."""
        for iteration in self.iterations:
            yield from iteration.decisions


def read_json(path: Path) -> Any:
    """The content of a JSON file of a run.

    Raises:
        RunFolderError: if it is missing or damaged.
    """
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RunFolderError(f"{path}: cannot be read ({error.strerror})") from error
    except ValueError as error:
        raise RunFolderError(f"{path}: expected JSON ({error})") from error


def _read_iteration(folder: RunFolder, number: int) -> Iteration:
    target = folder.iteration(number)
    decisions = tuple(_decision(number, entry) for entry in read_json(target / "decisions.json"))
    summary = read_json(target / "summary.json")
    return Iteration(number, read_episode(folder, number), decisions, summary)


def _decision(number: int, entry: dict[str, Any]) -> Decision:
    return Decision(
        number,
        entry["verdict"],
        entry["predicate"],
        entry.get("semantics", ""),
        entry.get("score"),
        entry["reason"],
        entry.get("inconsistency"),
    )

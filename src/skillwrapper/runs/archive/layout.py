"""Where everything stands in the folder of a run."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class RunLayout:
    """The paths in the folder of one run.

    Attributes:
        root: the folder.
    """

    root: Path

    @property
    def config(self) -> Path:
        """What was asked for; its presence makes the folder that of a run."""
        return self.root / "config.yaml"

    @property
    def domain(self) -> Path:
        """The domain as it was."""
        return self.root / "domain.yaml"

    @property
    def images(self) -> Path:
        """The pictures."""
        return self.root / "images"

    @property
    def calls(self) -> Path:
        """The store of model calls."""
        return self.root / "calls.sqlite"

    @property
    def model(self) -> Path:
        """The learned model."""
        return self.root / "model"

    @property
    def events(self) -> Path:
        """The log."""
        return self.root / "events.jsonl"

    @property
    def corrections(self) -> Path:
        """What people have corrected."""
        return self.root / "corrections.jsonl"

    @property
    def imported(self) -> Path:
        """The model that a person has edited and imported last."""
        return self.root / "imported.json"

    @property
    def curve(self) -> Path:
        """How true the model was after each iteration."""
        return self.root / "curve.json"

    @property
    def result(self) -> Path:
        """The figures of the run; there once it has ended."""
        return self.root / "result.json"

    def episode(self, number: int) -> Path:
        """The record of an episode, from 1."""
        return self.root / "episodes" / f"{number:03d}.jsonl"

    def recorded_episodes(self) -> int:
        """How many episodes are recorded: the highest number of one."""
        names = (path.stem for path in (self.root / "episodes").glob("*.jsonl"))
        return max((int(name) for name in names if name.isdigit()), default=0)

    def iteration(self, number: int) -> Path:
        """The folder of an iteration, from 1."""
        return self.root / "iterations" / f"{number:03d}"

    def summary(self, number: int) -> Path:
        """The figures of an iteration; written last, so that they mark it finished."""
        return self.iteration(number) / "summary.json"

    def finished_iterations(self) -> int:
        """How many iterations are finished: the last one that has a summary."""
        found = (self.root / "iterations").glob("*/summary.json")
        numbers = (path.parent.name for path in found)
        return max((int(name) for name in numbers if name.isdigit()), default=0)

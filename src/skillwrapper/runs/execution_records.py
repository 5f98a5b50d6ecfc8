"""The record of an execution: an episode that the next ``learn`` uses, and a log of what was
expected, seen and decided."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skillwrapper.files.writing import append_line
from skillwrapper.redaction import without_secrets
from skillwrapper.runs.archive import EpisodeFile
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.symbols.predicates import Literal
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class Surprise:
    """What went another way than the model said.

    Attributes:
        step: how many skills had been run, from 0.
        kind: ``"moved"``: the picture changed between two skills; ``"failed"``: a skill failed that
            should have succeeded; ``"effect"``: it succeeded, and something else came of it.
        instance: the skill; None between two skills.
        seen: literals that were seen where the opposite was expected.
    """

    step: int
    kind: str
    instance: SkillInstance | None
    seen: tuple[Literal, ...] = ()

    def __str__(self) -> str:
        seen = ", ".join(map(str, self.seen))
        match self.kind:
            case "moved":
                return f"something changed between two skills: {seen}"
            case "failed":
                return f"{self.instance} failed" + (f", and {seen}" if seen else "")
        return f"after {self.instance}: {seen}"


class ExecutionRecord:
    """Writes everything down as it happens; the episode begins with its first skill.

    Args:
        layout: of the run.
    """

    def __init__(self, layout: RunLayout) -> None:
        self._layout = layout
        self._episode: EpisodeFile | None = None
        self._seen: Observation | None = None
        self._log = _next_log(layout)

    @property
    def log(self) -> Path:
        """The log."""
        return self._log

    def note(self, event: str, **told: Any) -> None:
        """Put a line into the log; what a robot says in it is searched for secrets."""
        plain = {name: _without(value) for name, value in told.items()}
        append_line(self._log, {"event": event, **plain})

    def plan(self, steps: Iterable[SkillInstance]) -> None:
        """Note a plan."""
        self.note("planned", plan=[str(step) for step in steps])

    def surprise(self, surprise: Surprise) -> None:
        """Note a surprise."""
        self.note(
            "surprise",
            step=surprise.step,
            kind=surprise.kind,
            skill=str(surprise.instance) if surprise.instance else None,
            seen=[str(literal) for literal in surprise.seen],
        )

    def transition(self, scene: Scene, done: Transition, message: str) -> None:
        """Add an executed skill to the episode."""
        if self._episode is None:
            self._episode = EpisodeFile(self._layout, self._layout.recorded_episodes() + 1)
            self._episode.start(scene, 0, done.before, given=True)
            self._seen = done.before
        self._episode.add(done, self._seen or done.before, message)
        self._seen = done.after
        self.note("executed", skill=str(done.instance), success=done.success, message=message)


def _without(value: Any) -> Any:
    return without_secrets(value) if isinstance(value, str) else value


def _next_log(layout: RunLayout) -> Path:
    folder = layout.root / "executions"
    numbers = [int(path.stem) for path in folder.glob("*.jsonl") if path.stem.isdigit()]
    return folder / f"{max(numbers, default=0) + 1:03d}.jsonl"

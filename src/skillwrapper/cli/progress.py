"""Live progress of a run: what it does, what it found, what is left."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import TracebackType
from typing import Any

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from skillwrapper.runs.events import EventKind, RunEvent
from skillwrapper.runs.learn import Onlooker
from skillwrapper.runs.model_sessions import CallCounter

_SHOWN_DECISIONS = 8
_MARKS = {
    "accepted": ("+", "green"),
    "revived": ("^", "green"),
    "rejected": ("-", "dim"),
    "retracted": ("<", "yellow"),
    "dormant": ("z", "yellow"),
}


@dataclass
class _Status:
    iteration: int = 0
    total: int = 0
    planned: int = 0
    executed: int = 0
    succeeded: int = 0
    skill: str = ""
    decisions: list[Text] = field(default_factory=list)
    result: dict[str, Any] = field(default_factory=dict)


class RunProgress(Onlooker):
    """Shows the events of a run: a live panel on a terminal, a line an iteration elsewhere.

    Args:
        console: where to show it.
    """

    def __init__(self, console: Console) -> None:
        self._console = console
        self._counter: CallCounter | None = None
        self._status = _Status()
        self._live = Live(
            console=console, refresh_per_second=8, transient=True, get_renderable=self._draw
        )

    def __enter__(self) -> RunProgress:
        if self._console.is_terminal:
            self._live.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._live.stop()

    @property
    def calls(self) -> int:
        """How many model calls were answered so far."""
        return self._counter.answered if self._counter else 0

    @property
    def calls_made(self) -> int:
        """How many calls a model was asked; the rest came from a store."""
        return self._counter.made if self._counter else 0

    def opened(self, counter: CallCounter) -> None:
        """Remember where calls are counted."""
        self._counter = counter

    def happened(self, event: RunEvent) -> None:
        """Take note of an event."""
        status, data = self._status, event.data
        status.iteration = event.iteration
        if event.kind == EventKind.ITERATION_STARTED:
            status.total, status.executed, status.succeeded = data["total"], 0, 0
        elif event.kind == EventKind.SEQUENCE_CHOSEN:
            status.planned = len(data["sequence"])
        elif event.kind == EventKind.SKILL_EXECUTED:
            status.executed += 1
            status.succeeded += int(data["success"])
            status.skill = f"{data['instance']} {'done' if data['success'] else 'failed'}"
        elif event.kind == EventKind.PREDICATE_DECIDED:
            self._note(data["verdict"], data["predicate"], data["reason"])
        elif event.kind == EventKind.PREDICATE_DORMANT:
            self._note("dormant", data["predicate"], data["reason"])
        elif event.kind == EventKind.ITERATION_FINISHED:
            status.result = data
            self._console.print(self._iteration_line(), soft_wrap=True)

    def _note(self, verdict: str, predicate: str, reason: str) -> None:
        said = f" {verdict:9} {predicate} "
        self._status.decisions.append(Text.assemble(_MARKS[verdict], said, (reason, "dim")))

    def _iteration_line(self) -> Text:
        status, result = self._status, self._status.result
        left = result["inconsistencies"]
        colour = "green" if left == 0 else "yellow"
        return Text.assemble(
            f"iteration {status.iteration}/{status.total}  "
            f"{result['executions']} executions  {self.calls} model calls  "
            f"{result['predicates']} predicates  {result['operators']} operators  ",
            (f"{left} inconsistencies left", colour),
        )

    def _draw(self) -> RenderableType:
        status = self._status
        figures = Table.grid(padding=(0, 2))
        figures.add_row("iteration", f"{status.iteration} of {status.total}", status.skill)
        figures.add_row(
            "executions",
            f"{status.executed} of {status.planned}, {status.succeeded} successful",
            ProgressBar(total=max(status.planned, 1), completed=status.executed, width=30),
        )
        figures.add_row("model calls", str(self.calls), "")
        return Group(figures, *status.decisions[-_SHOWN_DECISIONS:])

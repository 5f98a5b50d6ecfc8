"""Live progress of a run: what it does, what it found, what is left."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import TracebackType

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from skillwrapper.runs.decisions import PredicateDecision
from skillwrapper.runs.events import (
    ImportedModelTried,
    IterationFinished,
    IterationStarted,
    PredicateDecided,
    RunEvent,
    RunStarted,
    SkillExecuted,
    SkillRecalled,
)
from skillwrapper.runs.figures import RunFigures
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


class RunProgress:
    """Shows the events of a run: a live panel on a terminal, a line an iteration elsewhere.

    An ``Observer`` of the run.

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

    def __call__(self, event: RunEvent) -> None:
        """Take note of an event."""
        status = self._status
        status.iteration = event.iteration
        match event:
            case RunStarted():
                self._counter = event.calls
            case IterationStarted():
                status.total, status.planned = event.iterations, event.budget
                status.executed = status.succeeded = 0
            case SkillExecuted() | SkillRecalled():
                self._count(event)
            case PredicateDecided():
                status.decisions.append(_describe(event.decision))
            case IterationFinished():
                self._console.print(self._iteration_line(event.result.figures), soft_wrap=True)
            case ImportedModelTried():
                self._console.print(f"note: {event.outcome}", soft_wrap=True, markup=False)

    def _count(self, event: SkillExecuted | SkillRecalled) -> None:
        status, done = self._status, event.transition
        status.executed += 1
        status.succeeded += int(done.success)
        status.skill = f"{done.instance} {'done' if done.success else 'failed'}"

    def _iteration_line(self, figures: RunFigures) -> Text:
        status, left = self._status, figures.inconsistencies
        colour = "green" if left == 0 else "yellow"
        return Text.assemble(
            f"iteration {status.iteration}/{status.total}  "
            f"{figures.executions} executions  {self.calls} model calls  "
            f"{figures.predicates} predicates  {figures.operators} operators  ",
            (f"{left} inconsistencies left", colour),
        )

    def _draw(self) -> RenderableType:
        status = self._status
        figures = Table.grid(padding=(0, 2))
        figures.add_row("iteration", f"{status.iteration} of {status.total}", Text(status.skill))
        figures.add_row(
            "executions",
            f"{status.executed} of {status.planned}, {status.succeeded} successful",
            ProgressBar(total=max(status.planned, 1), completed=status.executed, width=30),
        )
        figures.add_row("model calls", str(self.calls), "")
        return Group(figures, *status.decisions[-_SHOWN_DECISIONS:])


def _describe(decision: PredicateDecision) -> Text:
    said = f" {decision.verdict:9} {decision.predicate.signature} "
    return Text.assemble(_MARKS[decision.verdict], said, (decision.reason, "dim"))

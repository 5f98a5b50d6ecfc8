"""What happens in a run, as data: for the log, and for whoever watches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any


class EventKind(StrEnum):
    """What happened."""

    ITERATION_STARTED = "iteration_started"
    SEQUENCE_CHOSEN = "sequence_chosen"
    SKILL_EXECUTED = "skill_executed"
    PREDICATE_DECIDED = "predicate_decided"
    PREDICATE_DORMANT = "predicate_dormant"
    ITERATION_FINISHED = "iteration_finished"


@dataclass(frozen=True)
class RunEvent:
    """One event.

    Attributes:
        kind: what happened.
        iteration: in which iteration, from 1.
        data: plain data that describes it.
    """

    kind: EventKind
    iteration: int
    data: dict[str, Any]


Watcher = Callable[[RunEvent], None]

"""What planning came to."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from skillwrapper.errors import InternalError
from skillwrapper.symbols.predicates import Atom
from skillwrapper.world.skills import SkillInstance

SkillPlan = tuple[SkillInstance, ...]


class PlanningStatus(StrEnum):
    """How planning ended."""

    SOLVED = "solved"
    """There is at least one plan; the empty one if the goal holds already."""
    UNSOLVABLE = "unsolvable"
    """The planner has proven, within the model, that there is no plan."""
    TIMEOUT = "timeout"
    """No plan was found in the time given."""
    ERROR = "error"
    """The planner broke down; the log says how."""


@dataclass(frozen=True)
class PlanningResult:
    """The plans for a problem, or why there are none.

    Attributes:
        status: how planning ended.
        plans: skill plans, all different, the shortest ones first; none unless solved.
        seconds: wall-clock time.
        log: what the planner printed; after an error its first line says the cause.
        guessed: atoms that were unknown at the start and were taken as false.

    Raises:
        InternalError: if these do not go together.
    """

    status: PlanningStatus
    plans: tuple[SkillPlan, ...]
    seconds: float
    log: str = ""
    guessed: tuple[Atom, ...] = ()

    def __post_init__(self) -> None:
        problem = self._contradiction()
        if problem:
            raise InternalError(f"planning result: {problem}; please report it")

    @property
    def cause(self) -> str:
        """Why the planner broke down, in one sentence; empty if it did not."""
        return self.log.strip().splitlines()[0] if self.status is PlanningStatus.ERROR else ""

    def _contradiction(self) -> str | None:
        lengths = [len(plan) for plan in self.plans]
        if (self.status is PlanningStatus.SOLVED) != bool(self.plans):
            return f"expected plans if and only if solved, got {len(self.plans)} ({self.status})"
        if len(set(self.plans)) < len(self.plans):
            return "expected different plans, got one twice"
        if lengths != sorted(lengths):
            return f"expected the shortest plans first, got the lengths {lengths}"
        if self.seconds < 0:
            return f"expected a time of at least 0 s, got {self.seconds} s"
        if self.status is PlanningStatus.ERROR and not self.log.strip():
            return "expected a log with an error, got none"
        return None

"""Top-k planning with K*, by running its search directly.

The package's own ``plan_topk`` starts a second Python for Fast Downward's translator; our problems
are ground already (``sas.py``), so only the search is run, with the options of ``plan_topk``.
"""

from __future__ import annotations

import importlib.util
import signal
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, FiniteFloat, ValidationError

from skillwrapper.errors import MissingDependencyError
from skillwrapper.planning.problem import FINISH, PlanningProblem, action_number, is_finish
from skillwrapper.planning.process import Finished, Scratch
from skillwrapper.planning.result import PlanningStatus
from skillwrapper.planning.sas import print_sas

_SYMMETRIES = (
    "sym=structural_symmetries(time_bound=0,search_symmetries=oss,"
    "stabilize_initial_state=false,keep_operator_symmetries=true)"
)
_HOW = "pip install kstar-planner"
_PLANS_FILE = "plans.json"
_WITH_PLANS = (0, 1, 2, 3)
_WITHOUT_PLANS = (_PROVEN_UNSOLVABLE, _NONE_FOUND) = (11, 12)
_MEANINGS = {
    22: "ran out of memory",
    23: "ran out of time",
    24: "ran out of memory and time",
    32: "met a critical error",
    33: "did not understand its input",
    34: "does not support what it was given",
}
"""Fast Downward's exit codes, after which no plans can be expected."""
_GRACE = 0.5
"""Seconds between the time limit that the planner keeps itself and the one we enforce."""
_WELL_INSIDE = 0.9
"""Share of the time up to which "no plan found" is a proof (docs/semantics.md, D12)."""


Plans = tuple[tuple[int, ...], ...]
"""Plans as positions in a problem's actions."""


class _PlanEntry(BaseModel):
    cost: FiniteFloat
    actions: list[str]


class _PlansFile(BaseModel):
    """The layout of the file that the planner writes."""

    plans: list[_PlanEntry]


@dataclass(frozen=True)
class SearchOutcome:
    """What one search brought.

    Attributes:
        status: how it ended.
        plans: the cheapest first; none unless solved.
        log: why there are no plans, in a first line of its own, and what the planner printed.
    """

    status: PlanningStatus
    plans: Plans
    log: str


@dataclass(frozen=True)
class KStar:
    """K* on this machine.

    Attributes:
        program: its search program; None if there is none, which is the outcome of every search.
    """

    program: Path | None

    @classmethod
    def installed(cls) -> KStar:
        """The K* of the package ``kstar-planner``."""
        spec = importlib.util.find_spec("kstar_planner")
        folders = spec.submodule_search_locations if spec else None
        for folder in folders or ():
            program = Path(folder, "builds", "release", "bin", "downward")
            if program.is_file():
                return cls(program)
        return cls(None)

    def check_installed(self) -> None:
        """Make sure that there is a program, before much is done that needs it.

        Raises:
            MissingDependencyError: if there is none.
        """
        if self.program is None:
            raise MissingDependencyError("the planner K*", _HOW)

    def search(self, problem: PlanningProblem, plans: int, seconds: float) -> SearchOutcome:
        """The cheapest plans; whatever goes wrong with the planner is an outcome, too.

        Args:
            problem: the problem; the goal must not hold at the start.
            plans: how many plans at most.
            seconds: how long to search at most, the writing of the problem included.
        """
        if self.program is None:
            return self._broken(f"K* is not installed; {_HOW}")
        deadline = time.monotonic() + seconds
        text = print_sas(problem)
        remaining = deadline - time.monotonic()
        if remaining <= 0:
            return SearchOutcome(PlanningStatus.TIMEOUT, (), "no time was left for the search")
        try:
            with Scratch.made("skillwrapper-kstar-") as scratch:
                started = time.monotonic()
                finished = scratch.run(
                    self.command(problem, plans, remaining), text=text, seconds=remaining + _GRACE
                )
                share_of_time = (time.monotonic() - started) / remaining
                found = _read_plans(scratch.folder / _PLANS_FILE, len(problem.actions))
        except OSError as error:
            return self._broken(f"cannot be run: {error}")
        said = f"{finished.output}\nexit code {finished.code}"
        cause = _breakdown(finished, found)
        if cause:
            return self._broken(cause, said)
        return SearchOutcome(_status(finished, found, share_of_time), found.plans, said)

    def _broken(self, cause: str, said: str = "") -> SearchOutcome:
        named = f"{self.program} {cause}" if self.program else cause
        log = f"the planner {named}\n{said}".strip()
        return SearchOutcome(PlanningStatus.ERROR, (), log)

    def command(self, problem: PlanningProblem, plans: int, seconds: float) -> tuple[str, ...]:
        """The command line, as ``plan_topk`` would have it."""
        # With conditional effects landmark cut refuses to work, and symmetries give wrong plans.
        conditional = any(action.conditional for action in problem.actions)
        heuristic = "hmax" if conditional else "lmcut"
        search = (
            f"kstar({heuristic}(transform=undo_to_origin()), k={plans}, "
            f"max_time={max(seconds, 0.001):.3f}, "
            f"find_unordered_plans=false, dump_plan_files=false, "
            f"json_file_to_dump={_PLANS_FILE}{'' if conditional else ', symmetries=sym'})"
        )
        symmetries = () if conditional else ("--symmetries", _SYMMETRIES)
        plan_file = ("--internal-plan-file", "sas_plan")
        return (str(self.program), *symmetries, "--search", search, *plan_file)


@dataclass(frozen=True)
class _Found:
    """What stands in the file of plans, and what is wrong with it."""

    plans: Plans = ()
    fault: str = ""


def _read_plans(path: Path, actions: int) -> _Found:
    """The plans without their last action, the cheapest first; no file, no plans."""
    if not path.is_file():
        return _Found(fault=f"{path.name} is no file" if path.exists() else "")
    try:
        entries = _PlansFile.model_validate_json(path.read_bytes()).plans
        entries.sort(key=lambda entry: entry.cost)
        return _Found(tuple(_action_numbers(entry.actions, actions) for entry in entries))
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        return _Found(fault=f"{first['msg']}{f', at {place}' if place else ''}")
    except ValueError as error:
        return _Found(fault=str(error))


def _action_numbers(names: Sequence[str], actions: int) -> tuple[int, ...]:
    *steps, last = [name.strip() for name in names] or [""]
    if not is_finish(last):
        raise ValueError(f"expected a plan to end with {FINISH}, got '{last}'")
    numbers = tuple(map(action_number, steps))
    if numbers and max(numbers) >= actions:
        raise ValueError(f"expected the actions 0 to {actions - 1}, got {max(numbers)}")
    return numbers


def _breakdown(finished: Finished, found: _Found) -> str:
    """How the planner broke down; empty if it did not."""
    if finished.timed_out:
        return ""
    code = finished.code
    causes = (
        (finished.wrote_too_much, "was stopped because it filled the disk"),
        (code < 0, f"was ended by {_signal_name(-code)}"),
        (
            code not in (*_WITH_PLANS, *_WITHOUT_PLANS),
            _MEANINGS.get(code, f"ended with the exit code {code}"),
        ),
        (found.fault, f"wrote no plans that can be read: {found.fault}"),
        (
            not found.plans and code in _WITH_PLANS,
            "ended as if it had found plans, and wrote none",
        ),
    )
    return next((cause for applies, cause in causes if applies), "")


def _signal_name(number: int) -> str:
    try:
        name = signal.Signals(number).name
    except ValueError:
        name = f"the signal {number}"
    return f"{name}, perhaps for want of memory" if number == signal.SIGKILL else name


def _status(finished: Finished, found: _Found, share_of_time: float) -> PlanningStatus:
    """How a search ended that did not break down."""
    if found.plans:
        return PlanningStatus.SOLVED
    ended_by_itself = not finished.timed_out and "search::time limit" not in finished.output
    proven = finished.code == _PROVEN_UNSOLVABLE or share_of_time <= _WELL_INSIDE
    return PlanningStatus.UNSOLVABLE if ended_by_itself and proven else PlanningStatus.TIMEOUT

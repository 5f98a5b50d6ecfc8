"""Top-k planning with K*, by running its search directly.

The package's own ``plan_topk`` starts a second Python for Fast Downward's translator; our problems
are ground already (``sas.py``), so only the search is run, with the options of ``plan_topk``.
"""

from __future__ import annotations

import importlib.util
import json
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.errors import MissingDependencyError
from skillwrapper.planning.problem import FINISH, PlanningProblem, action_number
from skillwrapper.planning.process import Finished, run_to_end
from skillwrapper.planning.result import PlanningStatus
from skillwrapper.planning.sas import print_sas

_SYMMETRIES = (
    "sym=structural_symmetries(time_bound=0,search_symmetries=oss,"
    "stabilize_initial_state=false,keep_operator_symmetries=true)"
)
_PLANS_FILE = "plans.json"
_FOUND, _PROVEN_UNSOLVABLE, _NONE_FOUND = 0, 11, 12
_GRACE = 1.0
"""Seconds between the time limit that the planner keeps itself and the one we enforce."""
_WELL_INSIDE = 0.9
"""Share of the time limit up to which "no plan found" counts as a proof (DESIGN.md D12)."""


@dataclass(frozen=True)
class SearchOutcome:
    """What one search brought.

    Attributes:
        status: how it ended.
        plans: positions in the problem's actions, the cheapest plan first.
        log: what the planner printed.
    """

    status: PlanningStatus
    plans: tuple[tuple[int, ...], ...]
    log: str


@dataclass(frozen=True)
class KStar:
    """K* on this machine.

    Attributes:
        program: its search program.
    """

    program: Path

    @classmethod
    def installed(cls) -> KStar:
        """The K* of the package ``kstar-planner``.

        Raises:
            MissingDependencyError: if there is none.
        """
        spec = importlib.util.find_spec("kstar_planner")
        folders = spec.submodule_search_locations if spec else None
        for folder in folders or ():
            program = Path(folder, "builds", "release", "bin", "downward")
            if program.is_file():
                return cls(program)
        raise MissingDependencyError("the planner K*", "pip install kstar-planner")

    def search(self, problem: PlanningProblem, plans: int, seconds: float) -> SearchOutcome:
        """The cheapest plans.

        Args:
            problem: the problem; the goal must not hold at the start.
            plans: how many plans at most.
            seconds: how long to search at most.
        """
        with tempfile.TemporaryDirectory(prefix="skillwrapper-kstar-") as name:
            folder, started = Path(name), time.monotonic()
            finished = run_to_end(
                self.command(problem, plans, seconds),
                folder=folder,
                text=print_sas(problem),
                seconds=seconds + _GRACE,
            )
            elapsed = time.monotonic() - started
            found = _read_plans(folder / _PLANS_FILE)
        status = _status(finished, bool(found), elapsed / seconds)
        return SearchOutcome(status, found, f"{finished.output}\nexit code {finished.code}")

    def command(self, problem: PlanningProblem, plans: int, seconds: float) -> tuple[str, ...]:
        """The command line, as ``plan_topk`` would have it."""
        # With conditional effects landmark cut refuses to work, and symmetries give wrong plans.
        conditional = any(action.conditional for action in problem.actions)
        heuristic = "hmax" if conditional else "lmcut"
        search = (
            f"kstar({heuristic}(transform=undo_to_origin()), k={plans}, max_time={seconds}, "
            f"find_unordered_plans=false, dump_plan_files=false, "
            f"json_file_to_dump={_PLANS_FILE}{'' if conditional else ', symmetries=sym'})"
        )
        symmetries = () if conditional else ("--symmetries", _SYMMETRIES)
        plan_file = ("--internal-plan-file", "sas_plan")
        return (str(self.program), *symmetries, "--search", search, *plan_file)


def _read_plans(path: Path) -> tuple[tuple[int, ...], ...]:
    """The plans without their last action; none if the planner wrote no complete file."""
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))["plans"]
    except (OSError, ValueError):
        return ()
    entries.sort(key=lambda entry: entry["cost"])
    return tuple(
        tuple(action_number(name) for name in map(str.strip, entry["actions"]) if name != FINISH)
        for entry in entries
    )


def _status(finished: Finished, found: bool, share_of_time: float) -> PlanningStatus:
    if found:
        return PlanningStatus.SOLVED
    ended_by_itself = not finished.timed_out and "search::time limit" not in finished.output
    if finished.code == _PROVEN_UNSOLVABLE and ended_by_itself:
        return PlanningStatus.UNSOLVABLE
    if finished.code == _NONE_FOUND and ended_by_itself and share_of_time <= _WELL_INSIDE:
        return PlanningStatus.UNSOLVABLE
    if finished.timed_out or finished.code in {_FOUND, _NONE_FOUND}:
        return PlanningStatus.TIMEOUT
    return PlanningStatus.ERROR

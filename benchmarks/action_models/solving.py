"""AMLGym's problems, solved with a learned domain and judged by the true one.

As ``amlgym.metrics.problem_solving`` does it, with its planner and search, but for one thing: the
limit is on seconds of the processor, so that a busy machine takes nothing from anybody.
"""

from __future__ import annotations

import importlib
import logging
import os
import tempfile
import warnings
from collections import Counter
from collections.abc import Hashable, Iterator, Sequence
from contextlib import chdir, contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skillwrapper.action_models.strips import read_strips

_SEARCH = "let(hff,ff(),let(hcea,cea(),lazy_greedy([hff,hcea],preferred=[hff,hcea])))"
_PATIENCE = 10
"""So many times the limit may pass on the wall before a planner is stopped."""


@dataclass(frozen=True)
class Solved:
    """What came of the problems of a domain.

    Attributes:
        solved: the share with a plan that truly reaches the goal.
        timed_out: the share for which the planner took too long.
    """

    solved: float
    timed_out: float


class Solver:
    """Plans with Fast Downward as AMLGym does; domains that say the same are planned with once.

    Args:
        true: the domain that judges.
        problems: the problems.
        seconds: of the processor, for the search of a plan.
    """

    def __init__(self, true: Path, problems: Sequence[Path], seconds: int) -> None:
        self._true = str(true)
        self._problems = [str(path) for path in problems]
        self._seconds = seconds
        self._known: dict[Hashable, Solved] = {}

    def solve(self, learned: Path) -> Solved:
        """What comes of the problems with a domain."""
        content = _content(learned)
        if content not in self._known:
            with _quietly():
                found = Counter(self._outcome(str(learned.resolve()), p) for p in self._problems)
            size = len(self._problems)
            self._known[content] = Solved(found["solved"] / size, found["timed out"] / size)
        return self._known[content]

    def _outcome(self, learned: str, problem: str) -> str:
        """What comes of one problem."""
        planning = importlib.import_module("unified_planning.shortcuts")
        files = importlib.import_module("unified_planning.io")
        validate = importlib.import_module("amlgym.metrics._solving").validate_plan
        try:
            task = files.PDDLReader().parse_problem(learned, problem)
        except SyntaxError:
            return "syntax"
        result = self._plan(planning, task)
        if result.plan is None:
            return "timed out" if result.status.name == "TIMEOUT" else "no plan"
        truly = files.PDDLReader().parse_problem(self._true, problem)
        files.PDDLWriter(truly).write_plan(result.plan, "plan")
        return "solved" if validate(self._true, problem, "plan") else "wrong"

    def _plan(self, planning: Any, task: Any) -> Any:
        parameters = {
            "fast_downward_search_config": _SEARCH,
            "fast_downward_search_time_limit": f"{self._seconds}s",
        }
        planner = planning.OneshotPlanner(name="fast-downward", params=parameters)
        with planner:
            return planner.solve(task, timeout=_PATIENCE * self._seconds)


@contextmanager
def _quietly() -> Iterator[None]:
    """In a folder of its own, without the libraries' remarks."""
    logging.disable(logging.WARNING)
    importlib.import_module("unified_planning.shortcuts").get_environment().credits_stream = None
    with (
        Path(os.devnull).open("w") as nowhere,
        tempfile.TemporaryDirectory() as scratch,
        chdir(scratch),
        redirect_stdout(nowhere),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("ignore")
        yield


def _content(domain: Path) -> Hashable:
    """What a domain says, whatever the order in which it says it."""
    actions = read_strips(domain).actions.values()
    return frozenset(
        (a.name, a.parameters, frozenset(a.preconditions), frozenset(a.effects)) for a in actions
    )

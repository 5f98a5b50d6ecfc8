"""AMLGym's problems, solved with a learned domain and judged by the true one."""

from __future__ import annotations

import importlib
import logging
import os
import tempfile
import warnings
from collections.abc import Hashable, Sequence
from contextlib import chdir, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.action_models.strips import read_strips


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
        seconds: time limit for each.
    """

    def __init__(self, true: Path, problems: Sequence[Path], seconds: int) -> None:
        self._true = true
        self._problems = [str(path) for path in problems]
        self._seconds = seconds
        self._known: dict[Hashable, Solved] = {}

    def solve(self, learned: Path) -> Solved:
        """What comes of the problems with a domain."""
        content = _content(learned)
        if content not in self._known:
            self._known[content] = self._solve(learned)
        return self._known[content]

    def _solve(self, learned: Path) -> Solved:
        logging.disable(logging.WARNING)
        importlib.import_module(
            "unified_planning.shortcuts"
        ).get_environment().credits_stream = None
        metrics = importlib.import_module("amlgym.metrics")
        domains = str(learned.resolve()), str(self._true)
        with (
            Path(os.devnull).open("w") as nowhere,
            tempfile.TemporaryDirectory() as scratch,
            chdir(scratch),
            redirect_stdout(nowhere),
            warnings.catch_warnings(),
        ):
            warnings.simplefilter("ignore")
            found = metrics.problem_solving(
                *domains, self._problems, timeout=self._seconds, show_progress=False
            )
        return Solved(found["solving_ratio"], found["timed_out"])


def _content(domain: Path) -> Hashable:
    """What a domain says, whatever the order in which it says it."""
    actions = read_strips(domain).actions.values()
    return frozenset(
        (a.name, a.parameters, frozenset(a.preconditions), frozenset(a.effects)) for a in actions
    )

"""AMLGym's problems, solved with a learned domain and judged by the true one."""

from __future__ import annotations

import importlib
import logging
import os
import warnings
from collections.abc import Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Solved:
    """What came of the problems of a domain.

    Attributes:
        solved: the share with a plan that truly reaches the goal.
        timed_out: the share for which the planner took too long.
    """

    solved: float
    timed_out: float


def solve(learned: Path, true: Path, problems: Sequence[Path], seconds: int) -> Solved:
    """Plan with Fast Downward as AMLGym does.

    Args:
        learned: the domain that is planned with.
        true: the domain that judges.
        problems: the problems.
        seconds: time limit for each.
    """
    logging.disable(logging.WARNING)
    metrics = importlib.import_module("amlgym.metrics")
    names = [str(path) for path in problems]
    with Path(os.devnull).open("w") as nowhere, redirect_stdout(nowhere), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = metrics.problem_solving(
            str(learned), str(true), names, timeout=seconds, show_progress=False
        )
    return Solved(found["solving_ratio"], found["timed_out"])

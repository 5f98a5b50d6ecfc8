"""Models and problems as objects of unified-planning (extra ``up``)."""

from __future__ import annotations

import warnings
from typing import Any

from skillwrapper.errors import GoalError, MissingDependencyError
from skillwrapper.planning.export import Export

PROGRAM = '''\
"""A unified-planning Problem of what was learned: python problem.py, or import problem."""

from pathlib import Path

from unified_planning.io import PDDLReader

_HERE = Path(__file__).parent
problem = PDDLReader().parse_problem(str(_HERE / "domain.pddl"), str(_HERE / "problem.pddl"))

if __name__ == "__main__":
    print(problem)
'''
"""What makes a ``Problem`` of exported files."""


def to_unified_planning(exported: Export) -> Any:
    """The first problem of an export as a ``unified_planning.model.Problem``.

    Raises:
        MissingDependencyError: if unified-planning is not installed.
        GoalError: if the export has no problem.
    """
    try:
        from unified_planning.io import PDDLReader  # noqa: PLC0415
    except ImportError as error:
        how = "pip install 'skillwrapper[up]'"
        raise MissingDependencyError("unified-planning", how) from error
    if not exported.problems:
        raise GoalError("a unified-planning problem: expected a start and a goal, got none")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        return PDDLReader().parse_problem_string(exported.domain, exported.problems[0])

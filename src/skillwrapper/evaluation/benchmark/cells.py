"""Running one cell of an experiment: prepare the method, check it exactly, solve all problems."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from skillwrapper.errors import FileError, RunFolderError
from skillwrapper.evaluation.benchmark.call_costs import learning_costs, solving_costs
from skillwrapper.evaluation.benchmark.cell_records import CellRecord, ProblemLine
from skillwrapper.evaluation.benchmark.efficiency import efficiency_of
from skillwrapper.evaluation.exact.learning_curves import write_curve
from skillwrapper.evaluation.exact.verification import verify
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.method import CellContext, Method, Prepared
from skillwrapper.evaluation.problems.problems import ProblemSet
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.files.json_documents import read_json, read_records, read_text
from skillwrapper.files.writing import append_line, write_json

RESULT = "result.json"
"""Its presence means that the cell is finished."""

_PROBLEMS = "problems.jsonl"


@dataclass(frozen=True)
class CellResult:
    """What came of a cell.

    Attributes:
        cell: the cell.
        problems: one result for each problem.
        exact: precision, recall, ... of the final model on all states; None without a model, or
            where states cannot be listed or their predicates not read without error.
        learning: what learning took and brought; empty for methods that do not learn.
        efficiency: what executions were worth; None for methods that execute none to learn.
        seconds: time of everything, since the cell was last begun.
        costs: what model calls took, for ``learning`` (None for methods that ask nothing then) and
            ``solving``.
    """

    cell: Cell
    problems: tuple[ProblemResult, ...]
    exact: dict[str, Any] | None
    learning: dict[str, Any]
    efficiency: dict[str, Any] | None
    seconds: float
    costs: dict[str, dict[str, Any] | None] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Plain data with the attributes as keys."""
        problems = [p.to_json() for p in self.problems]
        return {**vars(self), "cell": vars(self.cell), "problems": problems}

    @classmethod
    def read(cls, folder: Path) -> CellResult:
        """The result of a finished cell.

        Raises:
            RunFolderError: if the file was damaged; names the line.
        """
        path = folder / RESULT
        try:
            record = read_json(path, CellRecord)
        except FileError as error:
            raise RunFolderError(
                f"{error}; remove the file and run the experiment again"
            ) from error
        data = json.loads(read_text(path))
        return cls(**{**data, "cell": record.cell, "problems": record.problems})


def run_cell(
    method: Method,
    context: CellContext,
    problems: ProblemSet,
    solved: Callable[[ProblemResult], None] = lambda result: None,
) -> CellResult:
    """Run a cell, or what is left of it; ``result.json`` is written last.

    Args:
        method: the method of the cell.
        context: what it gets.
        problems: what it is to solve.
        solved: told of every result as it comes.
    """
    started = time.monotonic()
    with method.prepare(context) as prepared:
        learning = _learning(prepared, time.monotonic() - started)
        exact = _verify(prepared)
        efficiency = efficiency_of(prepared, context.environment.domain)
        if efficiency is not None and efficiency.curve and prepared.run is not None:
            write_curve(prepared.run, efficiency.curve)
        results = _solve_all(prepared, context.folder / _PROBLEMS, problems, solved)
    learned = learning_costs(prepared.run)
    model = context.settings.model.name
    asked = solving_costs(prepared.calls, sum(r.calls for r in results), model)
    result = CellResult(
        cell=context.cell,
        problems=results,
        exact=exact,
        learning=learning,
        efficiency=efficiency.to_json() if efficiency else None,
        seconds=time.monotonic() - started,
        costs={"learning": learned.to_json() if learned else None, "solving": asked.to_json()},
    )
    write_json(context.folder / RESULT, result.to_json())
    return result


def _learning(prepared: Prepared, seconds: float) -> dict[str, Any]:
    """What learning took and brought; nothing for methods that do not learn."""
    if not prepared.figures:
        return {}
    successes = sum(t.success for e in prepared.episodes for t in e.transitions)
    return {**prepared.figures, "successes": successes, "seconds": seconds}


def _verify(prepared: Prepared) -> dict[str, Any] | None:
    if not prepared.stages or not prepared.exact:
        return None
    model = prepared.stages[-1].model
    found = verify(prepared.exact, model).to_json()
    return {**found, "predicates": len(model.predicates), "operators": len(model.operators)}


def _solve_all(
    prepared: Prepared,
    record: Path,
    problems: ProblemSet,
    solved: Callable[[ProblemResult], None],
) -> tuple[ProblemResult, ...]:
    """Solve the problems that are not on record yet."""
    known = (line.root for line in read_records(record, ProblemLine))
    results = {result.problem: result for result in known}
    for problem in problems.problems:
        if problem.name not in results:
            results[problem.name] = prepared.solver.solve(problem)
            append_line(record, results[problem.name].to_json())
        solved(results[problem.name])
    return tuple(results[problem.name] for problem in problems.problems)

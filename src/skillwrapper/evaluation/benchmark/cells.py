"""Running one cell of an experiment: prepare the method, check it exactly, solve all problems."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from skillwrapper.errors import RunFolderError
from skillwrapper.evaluation.benchmark.bills import learning_bill, solving_bill
from skillwrapper.evaluation.benchmark.efficiency import efficiency_of
from skillwrapper.evaluation.exact.learning_curves import write_curve
from skillwrapper.evaluation.exact.state_truth import StateTruth
from skillwrapper.evaluation.exact.verification import verify_labels
from skillwrapper.evaluation.methods.method import Bench, Cell, Method, Prepared
from skillwrapper.evaluation.problems.problems import ProblemSet
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.files.json_documents import read_lines
from skillwrapper.files.writing import append_line, write_json
from skillwrapper.grounding import AtomSpace

RESULT = "result.json"
"""Its presence means that the cell is finished."""

_PROBLEMS = "problems.jsonl"


@dataclass(frozen=True)
class CellResult:
    """What came of a cell.

    Attributes:
        cell: the cell.
        problems: one result for each problem.
        exact: precision, recall, ... of the final model on all states; None without a model.
        learning: what learning took and brought; empty for methods that do not learn.
        efficiency: what executions were worth; None for methods that execute none to learn.
        seconds: time of everything, since the cell was last begun.
        bills: what model calls took, for ``learning`` (None for methods that ask nothing then) and
            ``solving``.
    """

    cell: Cell
    problems: tuple[ProblemResult, ...]
    exact: dict[str, Any] | None
    learning: dict[str, Any]
    efficiency: dict[str, Any] | None
    seconds: float
    bills: dict[str, dict[str, Any] | None] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Plain data with the attributes as keys."""
        problems = [p.to_json() for p in self.problems]
        return {**vars(self), "cell": vars(self.cell), "problems": problems}

    @classmethod
    def read(cls, folder: Path) -> CellResult:
        """The result of a finished cell.

        Raises:
            RunFolderError: if the file was damaged.
        """
        path = folder / RESULT
        try:
            data = json.loads(path.read_text(encoding="utf-8"))
            problems = tuple(ProblemResult.from_json(p) for p in data["problems"])
            return cls(**{**data, "cell": Cell(**data["cell"]), "problems": problems})
        except (ValueError, KeyError, TypeError) as error:
            raise RunFolderError(
                f"{path}: expected the result of a cell, got something else ({error}); "
                "remove the file and run the experiment again"
            ) from error


def run_cell(
    method: Method,
    bench: Bench,
    problems: ProblemSet,
    solved: Callable[[ProblemResult], None] = lambda result: None,
) -> CellResult:
    """Run a cell, or what is left of it; ``result.json`` is written last.

    Args:
        method: the method of the cell.
        bench: what it gets.
        problems: what it is to solve.
        solved: told of every result as it comes.
    """
    started = time.monotonic()
    with method.prepare(bench) as prepared:
        learning = _learning(prepared, time.monotonic() - started)
        exact = _verify(prepared, bench.truth)
        efficiency = efficiency_of(prepared, bench.truth)
        if efficiency is not None and prepared.run is not None:
            write_curve(prepared.run, efficiency.curve)
        results = _solve_all(prepared, bench.folder / _PROBLEMS, problems, solved)
    learned = learning_bill(prepared.run)
    asked = solving_bill(prepared.calls, sum(r.calls for r in results), bench.settings.model)
    result = CellResult(
        cell=bench.cell,
        problems=results,
        exact=exact,
        learning=learning,
        efficiency=efficiency.to_json() if efficiency else None,
        seconds=time.monotonic() - started,
        bills={"learning": learned.to_json() if learned else None, "solving": asked.to_json()},
    )
    write_json(bench.folder / RESULT, result.to_json())
    return result


def _learning(prepared: Prepared, seconds: float) -> dict[str, Any]:
    """What learning took and brought; nothing for methods that do not learn."""
    if not prepared.figures:
        return {}
    successes = sum(t.success for e in prepared.episodes for t in e.transitions)
    return {**prepared.figures, "successes": successes, "seconds": seconds}


def _verify(prepared: Prepared, truth: StateTruth) -> dict[str, Any] | None:
    if not prepared.stages or prepared.label_all is None:
        return None
    model = prepared.stages[-1].model
    space = AtomSpace(model.predicates, truth.environment.domain.objects)
    labels = prepared.label_all(space)
    found = verify_labels(truth.environment, truth.space, model, labels).to_json()
    return {**found, "predicates": len(model.predicates), "operators": len(model.operators)}


def _solve_all(
    prepared: Prepared,
    record: Path,
    problems: ProblemSet,
    solved: Callable[[ProblemResult], None],
) -> tuple[ProblemResult, ...]:
    """Solve the problems that are not on record yet."""
    results = {line["problem"]: ProblemResult.from_json(line) for line in read_lines(record)}
    for problem in problems.problems:
        if problem.name not in results:
            results[problem.name] = prepared.solver.solve(problem)
            append_line(record, results[problem.name].to_json())
        solved(results[problem.name])
    return tuple(results[problem.name] for problem in problems.problems)

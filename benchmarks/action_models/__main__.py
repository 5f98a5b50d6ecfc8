"""Learners of action models side by side, on all of AMLGym's domains, in one run.

    python -m benchmarks.action_models [--learners ours sam-nonneg ...] [--domains ...]
        [--solve SECONDS] [--json] [--markdown FILE] [--keep FILE]

Seconds are of the processor, each learner in this one process, reading the files included.
Where the true model times out on a problem nobody's counts, so there nobody plans any further.
``--keep`` writes rows as they come, and takes up what an interrupted run had measured.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from benchmarks.action_models import gym
from benchmarks.action_models.metrics import TestState, predictive_power
from benchmarks.action_models.solving import Solver
from benchmarks.action_models.table import markdown
from skillwrapper.action_models.strips import Strips, read_strips

Row = dict[str, Any]


def main() -> None:
    """Measure what the command line asks for, and print it."""
    given = _arguments()
    rows = _kept(given.keep)
    for domain in given.domains:
        done = {row["learner"] for row in rows if row["domain"] == domain}
        for row in _rows(domain, [x for x in given.learners if x not in done], given.solve):
            rows.append(row)
            print(_line(row), file=sys.stderr, flush=True)
            if given.keep:
                with given.keep.open("a") as file:
                    file.write(json.dumps(row) + "\n")
    rows = [r for r in rows if r["learner"] in given.learners and r["domain"] in given.domains]
    means = {learner: _means(rows, learner) for learner in given.learners}
    if given.json:
        print(json.dumps({"means": means, "rows": rows}, indent=2))
    table = markdown(means, rows, given.solve)
    if given.markdown:
        given.markdown.write_text(table)
    elif not given.json:
        print(table)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.action_models")
    everyone = (gym.OURS, *gym.BASELINES)
    parser.add_argument("--learners", nargs="+", default=everyone, choices=everyone)
    parser.add_argument("--domains", nargs="+", default=gym.domain_names())
    parser.add_argument("--solve", type=int, default=60, help="seconds a problem; 0 for none")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--markdown", type=Path)
    parser.add_argument("--keep", type=Path, help="JSON lines, read and written")
    return parser.parse_args()


def _kept(path: Path | None) -> list[Row]:
    if path is None or not path.exists():
        return []
    return [json.loads(line) for line in path.read_text().splitlines()]


def _rows(domain: str, learners: Sequence[str], seconds: int) -> Iterator[Row]:
    """What learners do on a domain, beside how its true model does."""
    if not learners:
        return
    path = gym.domain_path(domain)
    tests, true = list(gym.test_states(domain)), read_strips(path)
    solver = Solver(path, gym.problem_paths(domain), seconds) if seconds else None
    reference = {f"true_{key}": value for key, value in _solved(solver, path).items()}
    if reference.get("true_timed_out"):
        solver = None
    for learner in learners:
        row = {"domain": domain, "learner": learner, **reference}
        try:
            yield {**row, **_measure(learner, domain, true, tests, solver)}
        except Exception as error:
            yield {**row, "failed": f"{type(error).__name__}: {error}"}


def _measure(
    learner: str, domain: str, true: Strips, tests: Sequence[TestState], solver: Solver | None
) -> Row:
    path, traces = gym.domain_path(domain), gym.trace_paths(domain)
    gym.load(learner)
    started = time.process_time()
    text = gym.learn(learner, path, traces)
    spent = time.process_time() - started
    with tempfile.TemporaryDirectory() as folder:
        learned = Path(folder) / "domain.pddl"
        learned.write_text(text)
        power = predictive_power(read_strips(learned), true, tests)
        return {**power, "seconds": spent, **_solved(solver, learned)}


def _solved(solver: Solver | None, domain: Path) -> dict[str, float]:
    return asdict(solver.solve(domain)) if solver else {}


def _means(rows: Sequence[Row], learner: str) -> Row:
    """Means over the domains; of problems, over those that the true domain solves in time."""
    own = [row for row in rows if row["learner"] == learner]
    done = [row for row in own if "failed" not in row]
    if not done:
        return {"failed": len(own)}
    figures = (
        "applicability_precision",
        "applicability_recall",
        "effects_precision",
        "effects_recall",
    )
    means: Row = {key: statistics.fmean(row[key] for row in done) for key in figures}
    fair = [row["solved"] for row in done if "solved" in row]
    means["solved"] = statistics.fmean(fair) if fair else None
    means["seconds_median"] = statistics.median(row["seconds"] for row in done)
    means["failed"] = len(own) - len(done)
    return means


def _line(row: Row) -> str:
    if "failed" in row:
        return f"{row['domain']:12} {row['learner']:12} failed: {row['failed']}"
    figures = [f"{row[k]:.3f}" for k in row if k.startswith(("applicability", "effects", "solved"))]
    return f"{row['domain']:12} {row['learner']:12} {' '.join(figures)} {row['seconds']:.3f} s"


if __name__ == "__main__":
    main()

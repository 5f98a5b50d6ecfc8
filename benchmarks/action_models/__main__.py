"""Learners of action models side by side, on all of AMLGym's domains, in one run.

    python -m benchmarks.action_models [--learners ours sam-nonneg ...] [--domains ...]
        [--solve SECONDS] [--json] [--markdown FILE]

Seconds are of the processor, each learner in this one process, reading the files included.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import tempfile
import time
import tracemalloc
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarks.action_models import gym
from benchmarks.action_models.metrics import TestState, predictive_power
from benchmarks.action_models.solving import solve
from benchmarks.action_models.table import markdown
from skillwrapper.action_models.strips import Strips, read_strips

Row = dict[str, Any]


def main() -> None:
    """Measure what the command line asks for, and print it."""
    given = _arguments()
    rows: list[Row] = []
    for domain in given.domains:
        tests, true = list(gym.test_states(domain)), read_strips(gym.domain_path(domain))
        reference = _solved(gym.domain_path(domain), domain, given.solve)
        for learner in given.learners:
            row = {"domain": domain, "learner": learner, **reference_of(reference)}
            rows.append({**row, **_measure(learner, domain, true, tests, given.solve)})
            print(_line(rows[-1]), file=sys.stderr, flush=True)
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
    return parser.parse_args()


def reference_of(solved: dict[str, float]) -> Row:
    """How the true domain does, beside which a learned one stands."""
    return {f"true_{key}": value for key, value in solved.items()}


def _measure(
    learner: str, domain: str, true: Strips, tests: Sequence[TestState], seconds: int
) -> Row:
    """One learner on one domain; a learner that fails has no figures but says why."""
    path, traces = gym.domain_path(domain), gym.trace_paths(domain)
    started = time.process_time()
    try:
        text = gym.learn(learner, path, traces)
    except Exception as error:
        return {"failed": f"{type(error).__name__}: {error}"}
    spent = time.process_time() - started
    with tempfile.TemporaryDirectory() as folder:
        learned = Path(folder) / "domain.pddl"
        learned.write_text(text)
        try:
            power = predictive_power(read_strips(learned), true, tests)
            return {**power, "seconds": spent, **_solved(learned, domain, seconds)}
        except Exception as error:
            return {"failed": f"{type(error).__name__}: {error}"}


def _solved(learned: Path, domain: str, seconds: int) -> dict[str, float]:
    if not seconds:
        return {}
    found = solve(learned, gym.domain_path(domain), gym.problem_paths(domain), seconds)
    return {"solved": found.solved, "timed_out": found.timed_out}


def memory(learner: str, domain: str) -> float:
    """The most that a learner takes of Python's memory, in MB."""
    tracemalloc.start()
    try:
        gym.learn(learner, gym.domain_path(domain), gym.trace_paths(domain))
        return tracemalloc.get_traced_memory()[1] / 1e6
    finally:
        tracemalloc.stop()


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
    fair = [row["solved"] for row in done if "solved" in row and row["true_timed_out"] == 0]
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

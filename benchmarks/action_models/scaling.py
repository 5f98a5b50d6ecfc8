"""How learning grows with the number of walks, beside SAM, and a million transitions.

    python -m benchmarks.action_models.scaling [--walks 100 1000 10000] [--domains ...]
        [--learners ...] [--limit SECONDS] [--million]

Every measurement is a process of its own: seconds of the processor for reading and learning, and
the most memory that it took. What is not done after ``--limit`` seconds of the processor is ended.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import tempfile
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from benchmarks.action_models import gym
from benchmarks.action_models.walks import Walker
from skillwrapper.action_models.learner import ActionModelLearner
from skillwrapper.action_models.strips import read_strips
from skillwrapper.action_models.trace_files import print_trace

DOMAINS = ("blocksworld", "barman", "ferry", "npuzzle")
SIZES = (100, 1000, 10_000)
STEPS = 15
MILLION = 1_000_000


def main() -> None:
    """Print seconds and memory."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.action_models.scaling")
    parser.add_argument("--walks", type=int, nargs="+", default=SIZES)
    parser.add_argument("--domains", nargs="+", default=DOMAINS)
    parser.add_argument("--learners", nargs="+", default=(gym.OURS, gym.POSITIVE_SAM))
    parser.add_argument("--limit", type=int, default=600, help="seconds of the processor")
    parser.add_argument("--million", action="store_true")
    given = parser.parse_args()
    for domain in given.domains:
        with tempfile.TemporaryDirectory() as folder:
            paths = _write(domain, max(given.walks), Path(folder))
            for walks in given.walks:
                for learner in given.learners:
                    spent = _apart(given.limit, _learn, learner, domain, paths[:walks])
                    print(f"{domain:12} {walks:6} walks {learner:12} {spent}", flush=True)
    if given.million:
        for size in (MILLION // 10, MILLION):
            spent = _apart(given.limit, _stream, given.domains[0], size)
            print(f"{given.domains[0]:12} {size:7} transitions {spent}", flush=True)


def _write(domain: str, walks: int, folder: Path) -> list[Path]:
    walker = Walker(domain, read_strips(gym.domain_path(domain)), seed=0)
    paths = []
    for number in range(walks):
        paths.append(folder / f"{number}_traj")
        paths[-1].write_text(print_trace(list(walker.walk(number, STEPS))))
    return paths


def _learn(learner: str, domain: str, paths: list[Path]) -> float:
    started = time.process_time()
    gym.learn(learner, gym.domain_path(domain), paths)
    return time.process_time() - started


def _stream(domain: str, size: int) -> float:
    """Learn from steps as they come, the same walks again and again: only learning counts."""
    true = read_strips(gym.domain_path(domain))
    walker = Walker(domain, true, seed=1)
    steps = [step for number in range(1000) for step in walker.walk(number, STEPS)]
    learner = ActionModelLearner(true.skeleton)
    started = time.process_time()
    for _ in range(size // len(steps) + 1):
        learner.add(steps)
    learner.learn()
    return time.process_time() - started


def _apart(limit: int, measure: Callable[..., float], *arguments: Any) -> str:
    """Run in a new process: its seconds, and the most memory that it took."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_report, args=(theirs, limit, measure, arguments))
    process.start()
    theirs.close()
    process.join()
    if process.exitcode or not ours.poll():
        return f"ended after {limit} s"
    seconds, megabytes = ours.recv()
    return f"{seconds:8.2f} s {megabytes:6.0f} MB"


def _report(
    end: Connection, limit: int, measure: Callable[..., float], arguments: tuple[Any, ...]
) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
    seconds = measure(*arguments)
    end.send((seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3))


if __name__ == "__main__":
    main()

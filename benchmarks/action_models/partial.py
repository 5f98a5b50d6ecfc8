"""What is lost where states are missing: AMLGym's traces with every so many states only.

    python -m benchmarks.action_models.partial [--every 1 2 3 5] [--domains ...] [--cautious]

Of every trace the first state stays, every second (third, ...), and the last; then only the first
and the last. Prints means over domains, and the least of both precisions.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Iterator, Sequence

from benchmarks.action_models import gym
from benchmarks.action_models.metrics import predictive_power
from skillwrapper.action_models.learner import ActionModelLearner
from skillwrapper.action_models.partial_traces import Attempt, Evidence, PartialState, TraceBuilder
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.reading import read_steps
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.strips import parse_strips, read_strips

_FIGURES = (
    "applicability_precision",
    "applicability_recall",
    "effects_precision",
    "effects_recall",
    "seconds",
)


def main() -> None:
    """Print a line for every share of states."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.action_models.partial")
    parser.add_argument("--every", type=int, nargs="+", default=(1, 2, 3, 5, sys.maxsize))
    parser.add_argument("--domains", nargs="+", default=gym.domain_names())
    parser.add_argument("--cautious", action="store_true", help="what no state shows is needed")
    given = parser.parse_args()
    settings = ActionModelSettings(cautious=given.cautious)
    print("| states | applicability precision | recall | effects precision | recall | CPU s |")
    print("|---" * 6 + "|")
    for every in given.every:
        rows = [_measure(domain, every, settings) for domain in given.domains]
        means = [f"{statistics.fmean(row[key] for row in rows):.3f}" for key in _FIGURES]
        print(f"| {every} | {' | '.join(means)} |", flush=True)
        worst = min(min(r["applicability_precision"], r["effects_precision"]) for r in rows)
        print(f"least precision of a domain: {worst:.3f}", file=sys.stderr)


def _measure(domain: str, every: int, settings: ActionModelSettings) -> dict[str, float]:
    true = read_strips(gym.domain_path(domain))
    started = time.process_time()
    learner = ActionModelLearner(true.skeleton, settings)
    for path in gym.trace_paths(domain):
        steps = [s for s in read_steps([path], true.skeleton) if isinstance(s, Step)]
        learner.add(_thinned(steps, every))
    text = print_model(learner.learn())
    seconds = time.process_time() - started
    learned = parse_strips(text, "learned.pddl")
    return {**predictive_power(learned, true, gym.test_states(domain)), "seconds": seconds}


def _thinned(steps: Sequence[Step], every: int) -> Iterator[Evidence]:
    builder = TraceBuilder()
    builder.state(PartialState(steps[0].before, None))
    for number, step in enumerate(steps, 1):
        builder.attempt(Attempt(step.action, step.arguments))
        if number % every == 0 or number == len(steps):
            yield from builder.state(PartialState(step.after, None))


if __name__ == "__main__":
    main()

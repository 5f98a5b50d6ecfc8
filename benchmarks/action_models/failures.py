"""What failed attempts bring: 1,000 random transitions of every domain, with and without failures.

    python -m benchmarks.action_models.failures

Every second attempt is drawn from what applies, the others from everything. *Exact*: the learned
domain applies where the true one does, in all of AMLGym's test states.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from pathlib import Path

from benchmarks.action_models import gym
from benchmarks.action_models.metrics import predictive_power
from benchmarks.action_models.walks import Walker
from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.strips import Strips, read_strips

TRANSITIONS = 1000
STEPS = 20
FAILING = 0.5


def main() -> None:
    """Print precision and recall by domain."""
    print("| domain | failures | without failures: precision / recall | with | exact |")
    print("|---|---|---|---|---|")
    exact = 0
    for domain in gym.domain_names():
        true, tests = read_strips(gym.domain_path(domain)), list(gym.test_states(domain))
        steps = transitions(domain, true)
        figures = []
        for chosen in ([s for s in steps if s.success], steps):
            power = predictive_power(_learned(true, chosen), true, tests)
            figures.append((power["applicability_precision"], power["applicability_recall"]))
        is_exact = figures[1] == (1.0, 1.0)
        exact += is_exact
        failed = sum(not s.success for s in steps)
        shown = " | ".join(f"{precision:.3f} / {recall:.3f}" for precision, recall in figures)
        print(f"| {domain} | {failed} | {shown} | {'yes' if is_exact else ''} |", flush=True)
    print(f"\nexact on {exact} of {len(gym.domain_names())} domains")


def transitions(domain: str, true: Strips) -> list[Step]:
    """The first transitions of random walks."""
    walker, steps = Walker(domain, true, seed=0), list[Step]()
    number = 0
    while len(steps) < TRANSITIONS:
        steps += walker.walk(number, STEPS, FAILING)
        number += 1
    return steps[:TRANSITIONS]


def _learned(true: Strips, steps: Iterable[Step]) -> Strips:
    model = learn_action_models(true.skeleton, steps)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "domain.pddl"
        path.write_text(print_model(model))
        return read_strips(path)


if __name__ == "__main__":
    main()

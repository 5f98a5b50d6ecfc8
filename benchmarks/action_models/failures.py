"""What failed attempts bring: 1,000 random transitions of every domain, with and without failures.

    python -m benchmarks.action_models.failures [--domains ...] [--failing SHARE] [--seed NUMBER]

A share of the attempts (half of them) is drawn from everything, the others from what applies. A
domain is *exact* if the learned one applies where the true one does, in all of AMLGym's test
states; *to the letter* if moreover every action has the literals of the true one for
preconditions, and no others. Recall is *lower* if of literals, or of what applies, less is found
than from the successes alone.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass

from benchmarks.action_models import gym
from benchmarks.action_models.metrics import predictive_power
from benchmarks.action_models.walks import Walker
from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.strips import Strips, parse_strips, read_strips

TRANSITIONS = 1000
STEPS = 20


@dataclass(frozen=True)
class Figures:
    """How good learned preconditions are.

    Attributes:
        precision: how much of what is said to apply does.
        recall: how much of what applies is said to.
        right: the share of learned literals that truly are preconditions.
        found: the share of true literals that were learned.
    """

    precision: float
    recall: float
    right: float
    found: float

    @property
    def is_exact(self) -> bool:
        return (self.precision, self.recall) == (1.0, 1.0)

    @property
    def is_literal(self) -> bool:
        return self.is_exact and (self.right, self.found) == (1.0, 1.0)

    def __str__(self) -> str:
        return f"{self.precision:.3f} / {self.recall:.3f} | {self.right:.2f} / {self.found:.2f}"


def main() -> None:
    """Print precision and recall by domain."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.action_models.failures")
    parser.add_argument("--domains", nargs="+", default=gym.domain_names())
    parser.add_argument("--failing", type=float, default=0.5, help="share drawn from everything")
    parser.add_argument("--seed", type=int, default=0, help="of the walks")
    given = parser.parse_args()
    print("| domain | failures | without: applies | literals | with: applies | literals | exact |")
    print("|---" * 7 + "|")
    exact, literal, lower = 0, 0, []
    for domain in given.domains:
        true, tests = read_strips(gym.domain_path(domain)), list(gym.test_states(domain))
        steps = transitions(domain, true, given.failing, given.seed)
        succeeded = [step for step in steps if step.success]
        figures = []
        for chosen in (succeeded, steps):
            learned = _learned(true, chosen)
            power = predictive_power(learned, true, tests)
            applies = power["applicability_precision"], power["applicability_recall"]
            figures.append(Figures(*applies, *_literals(learned, true)))
        first, last = figures
        lower += [domain] if last.recall < first.recall or last.found < first.found else []
        exact, literal = exact + last.is_exact, literal + last.is_literal
        verdict = "to the letter" if last.is_literal else "yes" if last.is_exact else ""
        failed = len(steps) - len(succeeded)
        print(f"| {domain} | {failed} | {figures[0]} | {last} | {verdict} |", flush=True)
    print(f"\nexact on {exact} of {len(given.domains)} domains, to the letter on {literal}")
    print(f"recall lower with failures: {', '.join(lower) or 'nowhere'}")


def transitions(domain: str, true: Strips, failing: float, seed: int) -> list[Step]:
    """The first transitions of random walks, a share of whose attempts is drawn from everything."""
    walker, steps = Walker(domain, true, seed), list[Step]()
    number = 0
    while len(steps) < TRANSITIONS:
        steps += walker.walk(number, STEPS, failing)
        number += 1
    return steps[:TRANSITIONS]


def _learned(true: Strips, steps: Iterable[Step]) -> Strips:
    return parse_strips(print_model(learn_action_models(true.skeleton, steps)), "learned.pddl")


def _literals(learned: Strips, true: Strips) -> tuple[float, float]:
    """Precision and recall of preconditions as literals, over all actions together."""
    shared = own = wanted = 0
    for name, action in true.actions.items():
        found = learned.actions[name].preconditions if name in learned.actions else ()
        shared += len({*found} & {*action.preconditions})
        own, wanted = own + len({*found}), wanted + len({*action.preconditions})
    return shared / max(1, own), shared / max(1, wanted)


if __name__ == "__main__":
    main()

"""Decoding many burger executions: seconds, whether they grow linearly, and memory.

Episodes of fifteen skills, half of them chosen among those that succeed; three readings in a
hundred are wrong. Run: ``python -m benchmarks.decoding``.
"""

from __future__ import annotations

import time
import tracemalloc

import numpy as np

from benchmarks.learning import Kitchen
from skillwrapper.grounding import Labels
from skillwrapper.perception.decoding.chains import Chain, Step, StepKind
from skillwrapper.perception.decoding.decoder import decode

SIZES = (300, 1_000, 3_000, 10_000)
EPISODE = 15
MISREAD = 0.03


def walk(kitchen: Kitchen, executions: int, seed: int) -> tuple[Chain, Labels]:
    """The chain of a random walk, and what is true in its pictures (nodes, atoms)."""
    chance = np.random.default_rng(seed)
    steps: dict[Step, int] = {Step(StepKind.RESET): 0}
    states, edges = [0], []
    for number in range(executions):
        if number % EPISODE == 0 and number:
            states.append(0)
            edges.append((0, len(states) - 1, 0))
        state = states[-1]
        good = np.flatnonzero(kitchen.success[state])
        pool = good if chance.random() < 0.5 else np.arange(kitchen.success.shape[1])
        which = int(chance.choice(pool))
        if kitchen.success[state, which]:
            instance = kitchen.domain.skill_instances[which]
            step = Step(StepKind.SUCCESS, instance.skill, instance.arguments)
            states.append(int(kitchen.following[state, which]))
            edges.append((len(states) - 2, len(states) - 1, steps.setdefault(step, len(steps))))
    rows = np.array(edges, dtype=np.intp)
    chain = Chain(
        kitchen.domain.scene(), len(states), tuple(steps), rows[:, 0], rows[:, 1], rows[:, 2]
    )
    return chain, kitchen.labels[states]


def main() -> None:
    """Print seconds for several sizes, their ratio to the first, memory, and errors left."""
    kitchen = Kitchen()
    print(f"decoding, {len(kitchen.space.atoms)} ground atoms, one core")
    first = 0.0
    for size in SIZES:
        chain, truth = walk(kitchen, size, seed=0)
        wrong = np.random.default_rng(1).random(truth.shape) < MISREAD
        read = np.where(wrong, 1 - truth, truth).astype(np.int8)
        started = time.process_time()
        found = decode([chain], kitchen.space.predicates, [read])
        seconds = time.process_time() - started
        left = int(((found.beliefs(0) > 0.5) != (truth == 1)).sum())
        tracemalloc.start()
        decode([chain], kitchen.space.predicates, [read])
        most = tracemalloc.get_traced_memory()[1] / 2**20
        tracemalloc.stop()
        first = first or seconds / size
        print(
            f"{size:6d} executions  {seconds:6.2f} s  time an execution, first row = 1: "
            f"{seconds / size / first:.2f}  {most:5.0f} MB  misread {int(wrong.sum())}, "
            f"wrong after decoding {left}"
        )


if __name__ == "__main__":
    main()

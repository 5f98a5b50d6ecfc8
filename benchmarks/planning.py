"""Time of a planner call beside that of a plain ``plan_topk`` on the same files.

Run: ``python -m benchmarks.planning``. A call of ours counts from lifted model to checked skill
plans, one of ``plan_topk`` from files on disk; the two take turns, in one run.
"""

from __future__ import annotations

import os
import random
import statistics
import tempfile
import time
from pathlib import Path

import numpy as np
from kstar_planner import planners

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.planning import Planner, PlanningProblem, goal_from_state, write_pddl

PROBLEMS = 20
AT_MOST = 0.6


def labels(space: AtomSpace, state: BurgerState) -> Labels:
    row = np.zeros(len(space.atoms), dtype=np.int8)
    row[space.columns(expert_atoms(state))] = 1
    return row


def measure(folder: Path, number: int, goal: BurgerState) -> tuple[float, float]:
    """Seconds of our call and of theirs, from the standard start to a state."""
    model, settings = expert_model(), Planner().settings
    ground = GroundModel.of(model, model.domain.objects)
    start = labels(ground.space, BurgerState())
    wanted = goal_from_state(ground.space, labels(ground.space, goal))
    files = write_pddl(PlanningProblem.of(ground, start, wanted), folder)
    clock = time.perf_counter()
    ours = Planner().plan(model, model.domain.objects, start, wanted)
    between = time.perf_counter()
    theirs = planners.plan_topk(
        files.domain, files.problem, settings.plans, timeout=int(settings.time_limit)
    )
    end = time.perf_counter()
    lengths = [len(plan) for plan in ours.plans]
    expected = [plan["cost"] - 1 for plan in theirs["plans"]]
    same = "same lengths" if lengths == expected else f"{lengths} instead of {expected}"
    print(f"{number:2}: {between - clock:.3f} s, plan_topk {end - between:.3f} s, {same}")
    return between - clock, end - between


def main() -> None:
    """Print both times for each problem, their medians and the ratio."""
    states = BurgerEnvironment().reachable_states()
    goals = random.Random(0).sample(states[1:], PROBLEMS)
    here = Path.cwd()
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)  # plan_topk leaves files in the working directory
        try:
            pairs = [measure(Path(name), number, goal) for number, goal in enumerate(goals)]
        finally:
            os.chdir(here)
    ours, theirs = (statistics.median(times) for times in zip(*pairs, strict=True))
    print(f"median: {ours:.3f} s, plan_topk {theirs:.3f} s")
    print(f"ratio: {ours / theirs:.3f} (at most {AT_MOST} asked for)")


if __name__ == "__main__":
    main()

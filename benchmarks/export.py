"""Whether other planners find in exported problems what we find.

Run: ``python -m benchmarks.export [COUNT [SEED [POPF]]]`` (50 and 0 by default), with ``pip
install unified-planning up-fast-downward pyperplan``; POPF is a program built from its sources. A
burger run is learned with the embedded model; start and goal are pictures of states, one reachable
from the other, drawn by the seed. Our planner gets the ground problem, Fast Downward the lifted
export (``pddl``) and, as pyperplan and POPF do, the one without negation (``plansys2``). All but
POPF, which takes the first plan that it finds within 30 seconds, are asked for a shortest plan.
Every plan is translated to skills by the table that is exported too, and run in the simulator. The
export without negation is held to the subset of PDDL that POPF takes.
"""

from __future__ import annotations

import random
import re
import subprocess
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from pyperplan import planner, search
from pyperplan.heuristics.lm_cut import LmCutHeuristic
from unified_planning.shortcuts import OneshotPlanner, get_environment

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.planning.export import Export
from skillwrapper.planning.unified import to_unified_planning
from skillwrapper.runs.launch import learn
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world.skills import SkillInstance

_PATIENCE = 30
"""Seconds after which POPF is stopped."""

Plan = tuple[SkillInstance, ...]
Task = tuple[BurgerState, BurgerState, int]
"""Start, goal, and the seed of their pictures."""


def by_fast_downward(exported: Export) -> Plan | None:
    """A shortest plan by Fast Downward, through unified-planning; blind, it takes all of PDDL."""
    settings = {"fast_downward_search_config": "astar(blind())"}
    with OneshotPlanner(name="fast-downward", params=settings) as engine:
        found = engine.solve(to_unified_planning(exported))
    if found.plan is None:
        return None
    steps = ((a.action.name, map(str, a.actual_parameters)) for a in found.plan.actions)
    return tuple(exported.table.instance(name, list(terms)) for name, terms in steps)


def by_pyperplan(exported: Export) -> Plan | None:
    """A shortest plan by A* with landmark cuts."""
    with tempfile.TemporaryDirectory() as folder:
        exported.write(Path(folder))
        found = planner.search_plan(
            f"{folder}/domain.pddl", f"{folder}/problem.pddl", search.astar_search, LmCutHeuristic
        )
    if found is None:
        return None
    steps = (step.name.strip("()").split() for step in found)
    return tuple(exported.table.instance(name, terms) for name, *terms in steps)


def by_popf(exported: Export, program: str) -> Plan | None:
    """The first plan of POPF; its lines are ``time: (action argument ...)  [duration]``."""
    with tempfile.TemporaryDirectory() as folder:
        exported.write(Path(folder))
        command = ["timeout", str(_PATIENCE), program, "domain.pddl", "problem.pddl"]
        said = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if "Solution Found" not in said.stdout:
        return None
    steps = (line.split() for line in re.findall(r"^[\d.]+: \((.*)\)", said.stdout, re.M))
    return tuple(exported.table.instance(name, terms) for name, *terms in steps)


def outside_subset(exported: Export) -> Iterator[str]:
    """What POPF would not take: anything but conjunctions, and negation but in effects."""
    for text in (exported.domain, *exported.problems):
        plain = re.sub(r";.*", "", text)
        yield from re.findall(r"\((?:forall|exists|or|imply|when|=)[\s)]", plain)
        for part in re.findall(r":precondition(.*?):effect|:goal(.*)|:init(.*?):goal", plain, re.S):
            yield from re.findall(r"\(not[\s)]", " ".join(part))
        for requirements in re.findall(r"\(:requirements(.*?)\)", plain):
            yield from {*requirements.split()} - {":strips", ":typing"}


@dataclass
class Tally:
    """What came of all problems.

    Attributes:
        plans: of how many problems each way found a plan.
        agreed: problems in which all ways say the same: one length, or that there is no plan.
        executed: problems of which every plan that was found reaches the goal in the simulator.
        within: problems of which the export without negation stays within the subset.
    """

    plans: Counter[str] = field(default_factory=Counter)
    agreed: int = 0
    executed: int = 0
    within: int = 0


def compare(
    learned: LearnedModel,
    environment: BurgerEnvironment,
    task: Task,
    tally: Tally,
    popf: str | None,
) -> None:
    """Let every planner solve one problem."""
    start, end, seed = task
    first = learned.read(environment.set_state(start, seed=seed))
    goal = learned.goal(learned.read(environment.set_state(end, seed=seed)))
    lifted, positive = (learned.export(to, first, goal) for to in ("pddl", "plansys2"))
    found = {
        "K*, ground": next(iter(learned.plan(first, goal).plans), None),
        "Fast Downward, pddl": by_fast_downward(lifted),
        "Fast Downward, plansys2": by_fast_downward(positive),
        "pyperplan, plansys2": by_pyperplan(positive),
    }
    tally.agreed += len({None if plan is None else len(plan) for plan in found.values()}) == 1
    if popf:
        found["POPF, plansys2"] = by_popf(positive, popf)
    plans = {name: plan for name, plan in found.items() if plan is not None}
    tally.plans.update(plans.keys())
    tally.executed += all(reaches(environment, task, plan) for plan in plans.values())
    tally.within += not any(outside_subset(positive))
    print(seed, *(f"{name}: {len(plan)}" for name, plan in plans.items()), sep="; ", flush=True)


def reaches(environment: BurgerEnvironment, task: Task, plan: Plan) -> bool:
    """Whether a plan runs through and ends in the state that was asked for."""
    state, end, _ = task
    for instance in plan:
        success, state = environment.successor(state, instance)
        if not success:
            return False
    return state == end


def main(count: int = 50, seed: int = 0, popf: str | None = None) -> None:
    """Print the lengths of all plans, and how often they agree."""
    warnings.simplefilter("ignore")
    get_environment().credits_stream = None
    environment, chance, tally = BurgerEnvironment(), random.Random(seed), Tally()
    states = list(environment.reachable_states())
    with tempfile.TemporaryDirectory() as folder:
        learn({"domain": "burger", "seed": 0, "iterations": 10}, folder)
        with LearnedModel.load(folder) as learned:
            for number in range(count):
                start = chance.choice(states)
                end = chance.choice(list(environment.reachable_states(start))[1:])
                compare(learned, environment, (start, end, number), tally, popf)
    print(f"{count} problems; plans found:")
    for name, times in tally.plans.items():
        print(f"{times:6} {name}")
    print(f"all ways agree: {tally.agreed}; all plans reach the goal: {tally.executed}; ", end="")
    print(f"within the subset of POPF: {tally.within}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]), *sys.argv[3:])

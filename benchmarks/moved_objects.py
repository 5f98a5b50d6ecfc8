"""Somebody moves an object between two skills of an execution with care.

Run: ``python -m benchmarks.moved_objects [COUNT [SEED]]`` (20 and 0 by default). A burger run is
learned with the embedded model. Each time start and goal are states of the kitchen, drawn by a
seed, so that the plan has three skills or more; after one of them, drawn as well, an object that
nothing lies on is put elsewhere: on its table, a free station or another object. The goal remains
solvable if it can be reached from there in truth; the simulator also judges whether it is reached.
"""

from __future__ import annotations

import json
import random
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import HAND, ITEMS, STATIONS, TABLE, BurgerState
from skillwrapper.errors import ConfigurationError
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.runs.careful_execution import CarefulExecution
from skillwrapper.runs.execution_records import ExecutionRecord
from skillwrapper.runs.launch import learn
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance

_SHORTEST = 3


class Meddled(BurgerEnvironment):
    """A kitchen in which somebody moves an object before the look that follows some skills.

    Args:
        after: how many skills are run before.
        chance: chooses what is moved, and where to.
    """

    def __init__(self, after: int, chance: random.Random) -> None:
        super().__init__()
        self.after, self._chance, self._run, self._running = after, chance, 0, False
        self.moved: tuple[BurgerState, BurgerState] | None = None

    def execute(self, instance: SkillInstance) -> Outcome:
        """As ever, with nobody near."""
        self._run, self._running = self._run + 1, True
        try:
            return super().execute(instance)
        finally:
            self._running = False

    def observe(self) -> Observation:
        """What is there, once somebody has been there."""
        if self._run == self.after and not self._running and self.moved is None:
            before = self.get_state()
            self.moved = before, self._chance.choice(displaced(before))
            self.set_state(self.moved[1])
        return super().observe()


def displaced(state: BurgerState) -> list[BurgerState]:
    """All states in which one object that can be taken lies elsewhere."""
    found = []
    for item in ITEMS:
        free = state.item_on(item) is None and state.place_of(item) != HAND
        for place in (TABLE, *STATIONS, *ITEMS) if free else ():
            try:
                other = state.moved(item, place)
            except ConfigurationError:
                continue  # there is no room, or it cannot lie there
            if other != state:
                found.append(other)
    return found


@dataclass(frozen=True)
class Verdict:
    """What came of one execution.

    Attributes:
        moved: whether somebody moved something at all.
        noticed: whether that is told as a surprise, right then.
        solvable: whether the goal could still be reached in truth.
        reached: whether the goal holds in truth at the end.
        claimed: whether the execution said so.
        recorded: whether all surprises are in the log.
        surprises: how many there were.
    """

    moved: bool
    noticed: bool
    solvable: bool
    reached: bool
    claimed: bool
    recorded: bool
    surprises: int


def execute_once(learned: LearnedModel, folder: Path, seed: int) -> Verdict:
    """Set up a problem by a seed, and carry it out while somebody meddles."""
    chance, world = random.Random(seed), BurgerEnvironment()
    states = world.reachable_states()
    while True:
        start = chance.choice(states)
        end = chance.choice(world.reachable_states(start))
        first = learned.read(world.set_state(start, seed=seed))
        goal = learned.goal(learned.read(world.set_state(end, seed=seed)))
        plans = learned.plan(first, goal, plans=1).plans
        if plans and len(plans[0]) >= _SHORTEST:
            break
    environment = Meddled(chance.randrange(1, len(plans[0])), chance)
    environment.set_state(start, seed=seed)
    record = ExecutionRecord(RunLayout(folder))
    report = CarefulExecution(learned, environment, goal, record).run()
    told = [json.loads(line) for line in record.log.read_text().splitlines()]
    steps = [surprise.step for surprise in report.surprises]
    solvable = environment.moved is not None and end in world.reachable_states(environment.moved[1])
    return Verdict(
        moved=environment.moved is not None,
        noticed=environment.after in steps,
        solvable=solvable,
        reached=environment.get_state() == end,
        claimed=str(report.ending) == "reached",
        recorded=sum(line["event"] == "surprise" for line in told) == len(steps),
        surprises=len(steps),
    )


def main(count: int = 20, first: int = 0) -> None:
    """Print what came of each execution, and the figures of all."""
    with tempfile.TemporaryDirectory() as place:
        run = Path(place) / "run"
        learn({"domain": "burger", "seed": 0, "iterations": 10}, run)
        with LearnedModel.load(run) as learned:
            found = [execute_once(learned, run, seed) for seed in range(first, first + count)]
    for number, one in enumerate(found, start=first):
        print(number, one)
    solvable = [one for one in found if one.solvable]
    print(f"{sum(one.moved for one in found)} of {count}: somebody moved an object")
    print(f"{sum(one.noticed for one in found)}: noticed right then")
    print(
        f"{sum(one.reached for one in solvable)} of {len(solvable)} solvable: goal reached in truth"
    )
    print(
        f"{sum(one.claimed == one.reached for one in found)}: said to be reached exactly if it was"
    )
    print(f"{sum(one.recorded for one in found)}: every surprise recorded", end="")
    print(f" ({sum(one.surprises for one in found)} in all)")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

"""The simulated arm at the table: how fast a skill is, and how often it succeeds with forces.

Run: ``python -m benchmarks.arms [EXECUTIONS]``. Needs the extra ``sim``. Without forces every skill
and picture is made on one core; with forces each skill is run so often (default: 50) from random
states in which it should succeed, with poses seen wrongly by 0 to 20 mm.
"""

from __future__ import annotations

import random
import sys
import time
from collections import Counter
from collections.abc import Iterator

import numpy as np

from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.physical import PhysicalPandaEnvironment
from skillwrapper.domains.panda.states import PandaState
from skillwrapper.domains.tabletop.physics import Troubles
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of
from skillwrapper.world.skills import SkillInstance, ground_skills

SECONDS_A_SKILL = 0.3
SUCCEED_AT_LEAST = 0.98
NOISE = (0.0, 0.005, 0.010, 0.015, 0.020)
"""Standard deviation along each axis, in metres."""
_FIRST_LAYOUT = 7000
"""Layouts from here on were not used when the skills were made."""

Pair = tuple[PandaState, SkillInstance]


class Unseen(PhysicalPandaEnvironment):
    """Without pictures."""

    def draw(self, state: PandaState, layout: int) -> Picture:
        """One black pixel."""
        return picture_of(np.zeros((1, 1, 3), np.uint8))


def main() -> None:
    """Print seconds a skill with its picture, and the curve over noise."""
    executions = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    print_speed()
    for noise in NOISE:
        print_successes(noise, executions)


def print_speed() -> None:
    """Processor seconds of a skill without forces, with its picture, and what was asked for."""
    environment = PandaEnvironment()
    environment.reset(seed=_FIRST_LAYOUT)
    seconds = []
    for seed in range(3):
        for state, instance in sample(environment, 4):
            environment.set_state(state, seed=_FIRST_LAYOUT + 1 + seed)
            start = time.process_time()
            environment.execute(instance)
            seconds.append(time.process_time() - start)
    mean, longest = sum(seconds) / len(seconds), max(seconds)
    share = mean / SECONDS_A_SKILL
    print(
        f"a skill with its picture: {mean:.3f} s, at most {longest:.3f} s; {share:.2f} of what is"
    )
    print(f"asked for ({SECONDS_A_SKILL} s), over {len(seconds)} skills")


def print_successes(noise: float, executions: int) -> None:
    """How often each skill succeeds, and whether the same seeds bring the same."""
    table = Unseen(Troubles(pose_noise=noise, turn_noise=5 * noise))
    table.reset(seed=0)
    succeeded, tried, ends = Counter[str](), Counter[str](), []
    start = time.process_time()
    for number, (state, instance) in enumerate(sample(table, executions)):
        seed = _FIRST_LAYOUT + number
        ends.append(_outcome(table, state, instance, seed))
        tried[instance.skill] += 1
        succeeded[instance.skill] += ends[-1][0]
    seconds = time.process_time() - start
    shares = ", ".join(f"{skill} {succeeded[skill]}/{tried[skill]}" for skill in tried)
    whole = sum(succeeded.values()) / sum(tried.values())
    again = [
        _outcome(table, state, instance, _FIRST_LAYOUT + number)
        for number, (state, instance) in enumerate(sample(table, executions))
        if number % 10 == 0
    ]
    same = sum(a == b for a, b in zip(again, ends[::10], strict=True))
    print(
        f"noise {1000 * noise:2.0f} mm: {100 * whole:5.1f} % ({shares}); "
        f"{same} of {len(again)} repeated alike; {seconds / sum(tried.values()):.2f} s each"
    )


def sample(environment: PandaEnvironment, count: int) -> Iterator[Pair]:
    """For each skill so many states with an instance that should succeed in them."""
    states = environment.reachable_states()
    instances = ground_skills(environment.domain.skills, environment.scene.objects)
    for skill in environment.domain.skill_by_name:
        chance = random.Random(f"benchmark of {skill}")
        pairs = [
            (state, instance)
            for state in states
            for instance in instances
            if instance.skill == skill and environment.obstacle(state, instance) is None
        ]
        for _ in range(count):
            yield chance.choice(pairs)


def _outcome(
    table: Unseen, state: PandaState, instance: SkillInstance, seed: int
) -> tuple[bool, PandaState]:
    table.set_state(state, seed=seed)
    outcome = table.execute(instance)
    if not np.isfinite(table.table.world.data.qpos).all():
        raise SystemExit(f"the simulation blew up: {instance} in {state}, seed {seed}")
    return outcome.success, table.get_state()


if __name__ == "__main__":
    main()

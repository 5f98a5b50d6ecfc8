"""The simulated arms: how fast a skill is, and how often it succeeds with forces.

Run: ``python -m benchmarks.arms [panda|kuka] [EXECUTIONS]``. Needs the extra ``sim``. Without
forces every skill and picture is made on one core; with forces each skill is run so often (default:
50) from random states in which it should succeed, with poses seen wrongly by 0 to 20 mm.
"""

from __future__ import annotations

import random
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.physical import PhysicalKukaEnvironment
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.physical import PhysicalPandaEnvironment
from skillwrapper.domains.tabletop.environment import ArmEnvironment, PhysicalArms
from skillwrapper.domains.tabletop.physics import Troubles
from skillwrapper.domains.tabletop.world import TableWorld
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of
from skillwrapper.world.skills import SkillInstance, ground_skills

SECONDS_A_SKILL = 0.3
SUCCEED_AT_LEAST = 0.98
NOISE = (0.0, 0.005, 0.010, 0.015, 0.020)
"""Standard deviation along each axis, in metres."""
_FIRST_LAYOUT = 7000
"""Layouts from here on were not used when the skills were made."""

Arms = ArmEnvironment[Any, Any]
Pair = tuple[Any, SkillInstance]


class Unseen(PhysicalArms[Any, Any]):
    """Without pictures."""

    def draw(self, state: object, layout: int) -> Picture:
        """One black pixel."""
        return picture_of(np.zeros((1, 1, 3), np.uint8))


class UnseenPanda(Unseen, PhysicalPandaEnvironment):
    """One arm, without pictures."""


class UnseenKuka(Unseen, PhysicalKukaEnvironment):
    """Two arms, without pictures."""


ROBOTS: Final[Mapping[str, tuple[type[Any], type[Any]]]] = MappingProxyType(
    {"panda": (PandaEnvironment, UnseenPanda), "kuka": (KukaEnvironment, UnseenKuka)}
)
"""Of each robot the environment without forces, and the one with them."""


def main() -> None:
    """Print seconds a skill with its picture, and the curve over noise."""
    words = sys.argv[1:]
    robot = words.pop(0) if words and words[0] in ROBOTS else "panda"
    executions = int(words[0]) if words else 50
    still, moved = ROBOTS[robot]
    print_speed(still())
    for noise in NOISE:
        print_successes(moved(Troubles(pose_noise=noise, turn_noise=5 * noise)), executions)


def print_speed(environment: Arms) -> None:
    """Processor seconds of a skill without forces, with its picture, and what was asked for."""
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


def print_successes(arms: Unseen, executions: int) -> None:
    """How often each skill succeeds, and whether the same seeds bring the same."""
    arms.reset(seed=0)
    succeeded, tried, ends, deepest = Counter[str](), Counter[str](), [], Deepest()
    arms.motion.on_frame = deepest
    start = time.process_time()
    for number, (state, instance) in enumerate(sample(arms, executions)):
        seed = _FIRST_LAYOUT + number
        ends.append(_outcome(arms, state, instance, seed))
        tried[instance.skill] += 1
        succeeded[instance.skill] += ends[-1][0]
    seconds = time.process_time() - start
    shares = ", ".join(f"{skill} {succeeded[skill]}/{tried[skill]}" for skill in tried)
    whole = sum(succeeded.values()) / sum(tried.values())
    again = [
        _outcome(arms, state, instance, _FIRST_LAYOUT + number)
        for number, (state, instance) in enumerate(sample(arms, executions))
        if number % 10 == 0
    ]
    same = sum(a == b for a, b in zip(again, ends[::10], strict=True))
    print(
        f"noise {1000 * arms.troubles.pose_noise:2.0f} mm: {100 * whole:5.1f} % ({shares}); "
        f"{same} of {len(again)} repeated alike; "
        f"{seconds / sum(tried.values()):.2f} s each; "
        f"nothing is more than {1000 * deepest.depth:.0f} mm inside anything"
    )


class Deepest:
    """How far anything is inside anything else during motions.

    Attributes:
        depth: in metres.
    """

    def __init__(self) -> None:
        self.depth = 0.0

    def __call__(self, world: TableWorld) -> None:
        """Look at the world."""
        self.depth = max(self.depth, -float(world.data.contact.dist.min(initial=0.0)))


def sample(environment: Arms, count: int) -> Iterator[Pair]:
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
    arms: Unseen, state: object, instance: SkillInstance, seed: int
) -> tuple[bool, object]:
    arms.set_state(state, seed=seed)
    outcome = arms.execute(instance)
    if not np.isfinite(arms.table.world.data.qpos).all():
        raise SystemExit(f"the simulation blew up: {instance} in {state}, seed {seed}")
    return outcome.success, arms.get_state()


if __name__ == "__main__":
    main()

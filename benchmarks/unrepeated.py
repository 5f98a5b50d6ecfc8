"""Learning from a robot whose pictures never repeat.

Run: ``python -m benchmarks.unrepeated [SEEDS]`` (100-103 by default). The burger kitchen is wrapped
as a robot: every picture has noise of up to 3 grey levels in every pixel, and before every look the
robot and everything around it may stand anywhere, so that no two pictures are alike and states
cannot be told apart by bytes. It must pass ``check --level robot``, and what is learned with it, by
the embedded model, is judged over all states of the kitchen, beside what is learned without.
"""

from __future__ import annotations

import random
import sys
import time
from dataclasses import dataclass, field
from io import BytesIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from benchmarks.exactness import judge
from benchmarks.worlds.measure import least_recall
from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.evaluation.exact.verification import verify
from skillwrapper.runs.launch import learn
from skillwrapper.world.conformance import examine_environment
from skillwrapper.world.robot import Robot, RobotEnvironment

_NOISE = 3
"""Grey levels, up or down."""
ITERATIONS = 10


@dataclass
class RestlessRobot(Robot):
    """The burger kitchen, never seen twice in the same way.

    Attributes:
        kitchen: what it works in.
        looks: how often it looked, which also seeds what is seen.
    """

    kitchen: BurgerEnvironment = field(default_factory=BurgerEnvironment)
    looks: int = 0

    def prepare(self, seed: int) -> None:
        """All items on their tables."""
        self.kitchen.reset(seed=seed)

    def look(self) -> dict[str, NDArray[np.uint8]]:
        """The kitchen from above, from elsewhere and with noise."""
        self.looks += 1
        layout = random.Random(f"stand {self.looks}").randrange(2**31)
        seen = self.kitchen.set_state(self.kitchen.get_state(), seed=layout)
        (picture,) = seen.pictures
        pixels = np.asarray(Image.open(BytesIO(picture.png)).convert("RGB"), dtype=np.int16)
        chance = np.random.default_rng(self.looks)
        noisy = pixels + chance.integers(-_NOISE, _NOISE, pixels.shape, endpoint=True)
        return {picture.camera: np.clip(noisy, 0, 255).astype(np.uint8)}

    def run(self, skill: str, *arguments: str) -> tuple[bool, str]:
        """A skill, as the rules of the kitchen have it."""
        call = next(
            i for i in self.kitchen.domain.skill_instances
            if (i.skill, i.arguments) == (skill, arguments)
        )  # fmt: skip
        outcome = self.kitchen.execute(call)
        return outcome.success, outcome.message


def restless() -> RobotEnvironment:
    """The robot as an environment."""
    robot = RestlessRobot()
    return RobotEnvironment(robot, robot.kitchen.domain)


def measure(seed: int, scenes: list[LabelledStates]) -> None:
    """Learn with and without, and print what both are worth."""
    for name, make in (("repeating", BurgerEnvironment), ("never repeating", restless)):
        began = time.process_time()
        settings = {"domain": "burger", "seed": seed, "iterations": ITERATIONS}
        result = learn(settings, environment=make())
        found = verify(scenes, result.model)
        pictures = {o.key for t in result.transitions for o in (t.before, t.after)}
        print(
            f"seed {seed}, {name:15}: P {found.precision or 0:.3f} least recall "
            f"{least_recall(found):.3f} E {found.effect_accuracy or 0:.3f}, "
            f"{len(result.model.operators)} operators, {result.figures.unresolved} left, "
            f"{len(pictures)} pictures, {time.process_time() - began:.0f} CPU s",
            flush=True,
        )


def main(seeds: str = "100-103") -> None:
    """Check the robot, then learn with each seed."""
    report = examine_environment(restless, level="robot")
    print(f"check --level robot: passes as a {report.level}")
    scenes = judge("burger")
    first, _, last = seeds.partition("-")
    for seed in range(int(first), int(last or first) + 1):
        measure(seed, scenes)


if __name__ == "__main__":
    main(*sys.argv[1:])

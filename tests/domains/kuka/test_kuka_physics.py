"""The two arms with forces: what should work works, what goes wrong is judged by geometry."""

from __future__ import annotations

import numpy as np
import pytest
from simulated_arms import needs_arms

from skillwrapper.domains.kuka.physical import PhysicalKukaEnvironment
from skillwrapper.domains.kuka.states import KukaState
from skillwrapper.domains.tabletop.physics import Troubles
from skillwrapper.domains.tabletop.poses import Pose
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of
from skillwrapper.world.skills import parse_skill_instance

pytestmark = needs_arms


class Unseen(PhysicalKukaEnvironment):
    """Without pictures, which take longer than everything else."""

    def draw(self, state: KukaState, layout: int) -> Picture:
        return picture_of(np.zeros((1, 1, 3), np.uint8))


@pytest.fixture(scope="module")
def careful() -> Unseen:
    return Unseen()


def run(arms: Unseen, *skills: str) -> list[bool]:
    return [arms.execute(parse_skill_instance(text)).success for text in skills]


def test_every_skill_works(careful: Unseen) -> None:
    careful.reset(seed=3)
    assert run(careful, "LeftArmPick(robot, jar)", "Open(robot, jar)") == [True] * 2
    assert run(careful, "RightArmPick(robot, knife)", "Scoop(robot, knife, jar)") == [True] * 2
    assert run(careful, "Spread(robot, knife, bread)", "Drop(robot, knife)") == [True] * 2
    assert careful.get_state() == KukaState(True, True, "table", "used")
    again = careful.execute(parse_skill_instance("Open(robot, jar)"))
    assert (again.success, again.changed) == (False, False)


def test_a_jar_that_slips_falls_and_the_same_seed_brings_the_same() -> None:
    arms, found = Unseen(Troubles(slips=1.0)), []
    for _ in range(2):
        arms.reset(seed=3)
        outcome = arms.execute(parse_skill_instance("LeftArmPick(robot, jar)"))
        found.append((outcome.success, outcome.message, arms.get_state()))
    assert found[0] == (False, "the jar slipped out of the gripper", KukaState())
    assert found[0] == found[1]


def test_a_blade_beside_the_bread_spreads_nothing(careful: Unseen) -> None:
    """Only where the end of the blade lies is the bread covered; most of it must be."""
    careful.reset(seed=3)
    careful.set_state(KukaState(True, True, "hand", "coated"), seed=3)
    table, skills = careful.table, careful.skills
    covered = []
    for x in (-0.15, -0.03, 0.0, 0.03):
        tip = table.world.pose("bread") @ Pose.at(x, 0.0, 0.02)
        skills._tip = lambda tip=tip: tip  # type: ignore[attr-defined]
        skills._cover()  # type: ignore[attr-defined]
        covered.append((len(table.topping), table.state().spread))
    del skills._tip  # type: ignore[attr-defined]
    assert covered[0] == (0, False)
    assert not covered[1][1]
    assert covered[-1][1]


def test_a_blade_over_the_jar_scoops_nothing(careful: Unseen) -> None:
    careful.reset(seed=3)
    careful.set_state(KukaState(True, True, "hand"), seed=3)
    careful.motion.seen = lambda pose: pose.shifted(z=0.06)  # type: ignore[method-assign]
    outcome = careful.execute(parse_skill_instance("Scoop(robot, knife, jar)"))
    del careful.motion.seen
    assert (outcome.success, outcome.message) == (False, "the blade is not in the jar")
    assert careful.get_state().blade == "clean"

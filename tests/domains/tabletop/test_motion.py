from __future__ import annotations

import numpy as np
import pytest
from simulated_arms import needs_arms, one_arm

from skillwrapper.domains.tabletop.motion import KinematicMotion, MotionFailed
from skillwrapper.domains.tabletop.poses import Pose, grip_down
from skillwrapper.domains.tabletop.world import TableWorld

pytestmark = needs_arms


@pytest.fixture(scope="module")
def shared() -> TableWorld:
    return one_arm()


@pytest.fixture
def world(shared: TableWorld) -> TableWorld:
    shared.clear()
    for thing in ("block", "tower"):
        shared.put_away(thing)
    return shared


def down_at(x: float, y: float, z: float) -> Pose:
    return Pose(np.array([x, y, z]), grip_down())


def test_the_grip_goes_where_it_is_told(world: TableWorld) -> None:
    KinematicMotion(world).move_to("arm", down_at(0.5, 0.2, 0.1))
    assert world.grip("arm").position == pytest.approx([0.5, 0.2, 0.1], abs=1e-3)


def test_what_is_held_goes_along_and_stays_where_it_is_left(world: TableWorld) -> None:
    world.put("block", Pose.at(0.5, 0.2, 0.02))
    motion = KinematicMotion(world)
    motion.move_to("arm", down_at(0.5, 0.2, 0.03), touching={"block"})
    motion.grasp("arm", "block", 0.02)
    motion.move_to("arm", down_at(0.4, -0.2, 0.03), touching={"table"})
    motion.release("arm")
    motion.go_home("arm")
    assert world.pose("block").position == pytest.approx([0.4, -0.2, 0.02], abs=2e-3)
    assert world.holder("block") is None


def test_nothing_goes_through_the_table(world: TableWorld) -> None:
    with pytest.raises(MotionFailed, match="the table is in the way"):
        KinematicMotion(world).move_to("arm", down_at(0.5, 0.2, -0.02))


def test_what_is_too_far_is_out_of_reach(world: TableWorld) -> None:
    with pytest.raises(MotionFailed, match="out of reach"):
        KinematicMotion(world).move_to("arm", down_at(1.5, 0.0, 0.1))


def test_a_way_around_is_found_and_is_free(world: TableWorld) -> None:
    motion = KinematicMotion(world)
    motion.move_to("arm", down_at(0.5, -0.2, 0.1))
    world.put("tower", Pose.at(0.5, 0.0, 0.15))
    with pytest.raises(MotionFailed, match="the tower is in the way"):
        motion.move_straight("arm", down_at(0.5, 0.2, 0.1))

    touched: list[bool] = []

    def look(seen: TableWorld) -> None:
        touched.append(not motion.is_free("arm", seen.joints("arm")))

    motion.on_frame = look
    motion.move_to("arm", down_at(0.5, 0.2, 0.1))
    assert len(touched) > 10
    assert not any(touched)
    assert world.grip("arm").position == pytest.approx([0.5, 0.2, 0.1], abs=1e-3)


def test_what_is_held_does_not_pass_through_things_either(world: TableWorld) -> None:
    motion = KinematicMotion(world)
    world.put("block", Pose.at(0.5, -0.2, 0.02))
    world.put("tower", Pose.at(0.5, 0.0, 0.15))
    motion.move_to("arm", down_at(0.5, -0.2, 0.03), touching={"block"})
    motion.grasp("arm", "block", 0.02)
    with pytest.raises(MotionFailed, match="the tower is in the way"):
        motion.move_to("arm", down_at(0.5, 0.0, 0.3))

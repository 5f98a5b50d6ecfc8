"""Motions and pictures of the two arms."""

from __future__ import annotations

import itertools

import pytest
from simulated_arms import needs_arms, why_no_pictures

from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.layout import make_layout
from skillwrapper.domains.kuka.states import KukaState
from skillwrapper.domains.tabletop.motion import KinematicMotion, MotionFailed
from skillwrapper.domains.tabletop.world import TableWorld
from skillwrapper.world.conformance import check_environment
from skillwrapper.world.skills import ground_skills, parse_skill_instance

pytestmark = needs_arms


@pytest.fixture(scope="module")
def environment() -> KukaEnvironment:
    return KukaEnvironment()


def test_every_skill_does_what_the_rules_say(environment: KukaEnvironment) -> None:
    """In one layout each state and skill once; the geometry is judged, not the rules."""
    instances = ground_skills(environment.domain.skills, environment.scene.objects)
    table, count = environment.table, 0
    for state, instance in itertools.product(environment.reachable_states(), instances):
        if environment.obstacle(state, instance) is None:
            table.arrange(state, make_layout(5))
            assert table.state() == state
            environment.skills.run(instance)
            assert table.state() == environment.effect(state, instance), (state, instance)
            count += 1
    assert count == 15


def test_the_lid_follows_the_jar_until_it_is_opened(environment: KukaEnvironment) -> None:
    table = environment.table
    table.arrange(KukaState(), make_layout(1))
    for skill, together in (("LeftArmPick(robot, jar)", True), ("Open(robot, jar)", False)):
        environment.skills.run(parse_skill_instance(skill))
        apart = table.world.pose("lid").position - table.world.pose("jar").position
        assert (abs(apart).max() < 0.11) == together


def test_nothing_is_passed_through_on_the_way(environment: KukaEnvironment) -> None:
    """The bread and the holder are touched at no moment of opening the jar."""
    table = environment.table
    table.arrange(KukaState(jar_held=True), make_layout(4))
    motion, seen = KinematicMotion(table.world), list[str]()

    def look(world: TableWorld) -> None:
        for arm in world.arms:
            if not motion.is_free(arm, world.joints(arm), {"jar", "lid", "left", "right", "table"}):
                seen.append(arm)

    environment.motion.on_frame = look
    environment.skills.run(parse_skill_instance("Open(robot, jar)"))
    environment.motion.on_frame = None
    assert not seen


def test_a_skill_without_a_free_path_fails(environment: KukaEnvironment) -> None:
    table = environment.table
    table.arrange(KukaState(), make_layout(4))
    table.world.put("bread", table.world.pose("jar").shifted(y=0.06, z=0.05))
    with pytest.raises(MotionFailed, match="the bread is in the way"):
        environment.skills.run(parse_skill_instance("LeftArmPick(robot, jar)"))


def test_conforms() -> None:
    if why_no_pictures():
        pytest.skip(why_no_pictures())
    assert check_environment(KukaEnvironment, steps=6, sample=1)

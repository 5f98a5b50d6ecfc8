"""Motions and pictures of the table."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from simulated_arms import needs_arms, why_no_pictures

from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.layout import make_layout
from skillwrapper.domains.panda.objects import HANDLING
from skillwrapper.domains.panda.skills import PandaSkills
from skillwrapper.domains.panda.states import THINGS, PandaState
from skillwrapper.domains.panda.table import PandaTable, Setting
from skillwrapper.domains.tabletop.motion import KinematicMotion, MotionFailed
from skillwrapper.domains.tabletop.world import TableWorld
from skillwrapper.world.conformance import check_environment
from skillwrapper.world.skills import ground_skills, parse_skill_instance

pytestmark = needs_arms


@pytest.fixture(scope="module")
def table() -> PandaTable:
    return PandaTable(Setting())


def test_every_skill_does_what_the_rules_say(table: PandaTable) -> None:
    """In one layout each state and skill once; the geometry is judged, not the rules."""
    environment = PandaEnvironment()
    skills = PandaSkills(table, KinematicMotion(table.world))
    environment._scene = environment.domain.scene("table")
    instances = ground_skills(environment.domain.skills, environment.scene.objects)
    layout, count = make_layout(THINGS, 4), 0
    for state, instance in itertools.product(environment.reachable_states(), instances):
        if environment.obstacle(state, instance) is None:
            table.arrange(state, layout)
            skills.run(instance)
            assert table.state() == environment.effect(state, instance), (state, instance)
            count += 1
    assert count == 66


def test_states_are_arranged_as_they_are_judged(table: PandaTable) -> None:
    environment = PandaEnvironment()
    environment._scene = environment.domain.scene("table")
    for state in environment.reachable_states():
        table.arrange(state, make_layout(THINGS, 2))
        assert table.state() == state


def test_nothing_is_passed_through_on_the_way(table: PandaTable) -> None:
    """At no moment of these skills does the arm, or what it holds, touch what it must not."""
    table.arrange(PandaState(held="teapot"), make_layout(THINGS, 4))
    motion = KinematicMotion(table.world)
    seen: list[str] = []

    def look(world: TableWorld) -> None:
        allowed = {"plate"} if world.held else {"plate", "teapot"}
        if not motion.is_free("arm", world.joints("arm"), allowed):
            seen.append("touched")

    motion.on_frame = look
    skills = PandaSkills(table, motion)
    for text in ("Pour(robot, teapot, mug)", "Stack(robot, teapot, plate)"):
        skills.run(parse_skill_instance(text))
    assert not seen


def test_a_skill_without_a_free_path_fails(table: PandaTable) -> None:
    table.arrange(PandaState(), make_layout(THINGS, 4))
    bowl = table.world.pose("bowl").position
    table.world.put("plate", table.world.pose("bowl").shifted(z=0.05))
    with pytest.raises(MotionFailed, match="the plate is in the way"):
        PandaSkills(table, KinematicMotion(table.world)).pick("bowl")
    assert np.allclose(table.world.pose("bowl").position, bowl)


def test_layouts_leave_room_and_repeat() -> None:
    for seed in range(20):
        layout = make_layout(THINGS, seed)
        assert layout == make_layout(THINGS, seed)
        for a, b in itertools.combinations(THINGS, 2):
            apart = np.hypot(layout[a].x - layout[b].x, layout[a].y - layout[b].y)
            assert apart > HANDLING[a].radius + HANDLING[b].radius


def test_conforms() -> None:
    if why_no_pictures():
        pytest.skip(why_no_pictures())
    assert check_environment(PandaEnvironment, steps=8, sample=1)

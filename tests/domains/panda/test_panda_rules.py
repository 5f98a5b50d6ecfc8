"""The abstract semantics, by enumeration; nothing here needs MuJoCo."""

from __future__ import annotations

import pytest

from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.states import PICKUPABLE, PandaState, start_of
from skillwrapper.errors import ConfigurationError
from skillwrapper.world.skills import parse_skill_instance

SIZES = {"pouring": 6, "wiping": 5, "stacking": 7, "table": 34}


def in_scene(scene: str) -> PandaEnvironment:
    """The environment as a reset leaves it, without its picture."""
    environment = PandaEnvironment()
    environment._scene = environment.domain.scene(scene)
    return environment


@pytest.mark.parametrize(("scene", "size"), SIZES.items())
def test_so_many_states_are_reachable(scene: str, size: int) -> None:
    environment = in_scene(scene)
    assert len(environment.reachable_states()) == size


def test_from_a_clean_plate_there_are_fewer() -> None:
    assert len(in_scene("table").reachable_states(PandaState(dirty=False))) == 26


def test_a_plate_waits_dirty_where_there_is_a_sponge() -> None:
    assert start_of(["plate", "sponge"]).dirty
    assert not start_of(["plate", "bowl"]).dirty


@pytest.mark.parametrize(
    ("skill", "state", "obstacle"),
    [
        ("Pick(robot, bowl)", PandaState(), None),
        ("Pick(robot, bowl)", PandaState(stacked="bowl"), None),
        ("Pick(robot, bowl)", PandaState(held="sponge"), "the hand is full"),
        ("Place(robot, bowl)", PandaState(held="bowl"), None),
        ("Place(robot, bowl)", PandaState(), "does not hold"),
        ("Pour(robot, teapot, mug)", PandaState(held="teapot"), None),
        ("Pour(robot, teapot, mug)", PandaState(held="teapot", full=True), "full already"),
        ("Pour(robot, teapot, mug)", PandaState(), "does not hold"),
        ("Stack(robot, bowl, plate)", PandaState(held="bowl"), None),
        ("Stack(robot, bowl, plate)", PandaState(held="bowl", dirty=True), "is dirty"),
        ("Stack(robot, bowl, plate)", PandaState(held="bowl", stacked="teapot"), "stands on"),
        ("Wipe(robot, sponge, plate)", PandaState(held="sponge", dirty=True), None),
        ("Wipe(robot, sponge, plate)", PandaState(held="sponge"), "clean already"),
        ("Wipe(robot, sponge, plate)", PandaState(dirty=True), "does not hold"),
    ],
)
def test_when_skills_work(skill: str, state: PandaState, obstacle: str | None) -> None:
    found = PandaEnvironment().obstacle(state, parse_skill_instance(skill))
    assert (found is None) if obstacle is None else (obstacle in (found or ""))


def test_a_full_mug_stays_full_and_a_clean_plate_clean() -> None:
    environment = in_scene("table")
    for state in environment.reachable_states(PandaState(full=True, dirty=False)):
        assert state.full
        assert not state.dirty


@pytest.mark.parametrize(
    "wrong",
    [{"held": "mug"}, {"stacked": "plate"}, {"held": "bowl", "stacked": "bowl"}],
)
def test_impossible_states_are_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ConfigurationError):
        PandaState(**wrong)  # type: ignore[arg-type]


def test_states_are_written_and_read() -> None:
    environment = in_scene("table")
    for thing in PICKUPABLE:
        state = PandaState(held=thing, full=True)
        assert environment.state_from_data(environment.state_to_data(state)) == state

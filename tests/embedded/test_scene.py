from __future__ import annotations

import pytest

from skillwrapper.embedded.scene import Box, Scene, Thing

BOX = Box(10, 20, 30, 60)


@pytest.fixture
def scene() -> Scene:
    kinds = {"robot": "robot", "stove": "station", "table_1": "table"}
    items = dict.fromkeys(("patty", "lettuce", "topbun", "bun"), "item")
    return Scene(
        things=tuple(Thing(name, kind, BOX) for name, kind in {**kinds, **items}.items()),
        on={"patty": "stove", "lettuce": "patty", "topbun": "lettuce"},
        held={"bun": "robot"},
        attributes={"lettuce": frozenset({"cut"})},
    )


def test_box_tells_its_measures() -> None:
    assert (BOX.centre, BOX.width, BOX.height) == ((20.0, 40.0), 20, 40)


def test_things_by_kind_and_name(scene: Scene) -> None:
    assert scene.names("item") == ("patty", "lettuce", "topbun", "bun")
    assert scene.kind("stove") == "station"
    assert scene.kind("fork") == ""
    assert "stove" in scene
    assert "fork" not in scene


def test_direct_relations(scene: Scene) -> None:
    assert scene.is_on("lettuce", "patty")
    assert not scene.is_on("lettuce", "stove")
    assert scene.directly_on("stove") == ("patty",)
    assert scene.directly_on("table_1") == ()
    assert scene.is_clear("topbun")
    assert not scene.is_clear("patty")


def test_relations_through_others(scene: Scene) -> None:
    assert tuple(scene.supports("topbun")) == ("lettuce", "patty", "stove")
    assert scene.is_above("topbun", "stove")
    assert not scene.is_above("stove", "topbun")
    assert scene.resting_place("topbun") == "stove"
    assert scene.resting_place("bun") is None


def test_hand_and_attributes(scene: Scene) -> None:
    assert scene.is_held("bun")
    assert not scene.is_held("patty")
    assert scene.held_by("robot") == ("bun",)
    assert scene.has("lettuce", "cut")
    assert not scene.has("patty", "cut")


def test_a_scene_may_hold_things_alone() -> None:
    scene = Scene((Thing("robot", "robot", BOX),))
    assert scene.held_by("robot") == ()
    assert scene.is_clear("robot")

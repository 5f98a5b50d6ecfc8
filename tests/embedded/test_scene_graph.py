"""Scene graphs say what is where, and refuse what makes no sense."""

from __future__ import annotations

import pytest

from skillwrapper.embedded.scene_graph import Box, SceneGraph, Thing
from skillwrapper.errors import ConfigurationError

BOX = Box(10, 20, 30, 60)
KINDS = {"robot": "robot", "stove": "station", "table": "table",
         **dict.fromkeys(("patty", "lettuce", "topbun", "bun"), "item")}  # fmt: skip
THINGS = tuple(Thing(name, kind, BOX, name == "table") for name, kind in KINDS.items())
GRAPH = SceneGraph(
    THINGS,
    {
        "on": {("patty", "stove"), ("lettuce", "patty"), ("topbun", "lettuce")},
        "held": {("bun", "robot")},
        "in": frozenset(),
    },
    {"lettuce": {"cut": True}, "patty": {"cooked": False}},
    {"dark": False},
)


def test_box_tells_its_measures() -> None:
    assert (BOX.centre, BOX.width, BOX.height) == ((20.0, 40.0), 20, 40)


def test_things_by_kind_and_name() -> None:
    assert GRAPH.names("item") == ("patty", "lettuce", "topbun", "bun")
    assert GRAPH.kind("stove") == "station"
    assert GRAPH.kind("fork") == ""
    assert "stove" in GRAPH
    assert "fork" not in GRAPH


def test_relations() -> None:
    assert GRAPH.related("on", "lettuce", "patty")
    assert not GRAPH.related("on", "lettuce", "stove")
    assert not GRAPH.related("beside", "lettuce", "patty")
    assert tuple(GRAPH.chain("on", "topbun")) == ("lettuce", "patty", "stove")


def test_a_chain_in_a_circle_ends() -> None:
    circle = SceneGraph(THINGS, {"on": {("patty", "bun"), ("bun", "patty")}})
    assert tuple(circle.chain("on", "patty")) == ("bun",)


def test_attributes() -> None:
    assert GRAPH.has("lettuce", "cut")
    assert not GRAPH.has("patty", "cooked")
    assert not GRAPH.has("stove", "cut")


def test_the_outline_is_what_might_be_the_case() -> None:
    outline = GRAPH.outline
    assert outline.relations == ("held", "in", "on")
    assert outline.attributes == (("cooked", {"item"}), ("cut", {"item"}))
    assert outline.conditions == ("dark",)
    assert outline.named("station") == ("stove",)
    assert outline.named("table") == ()
    assert SceneGraph(THINGS).outline.things == outline.things


@pytest.mark.parametrize(
    "graph",
    [
        {"relations": {"on": {("fork", "table")}}},
        {"attributes": {"fork": {"clean": True}}},
    ],
)
def test_what_is_not_seen_is_not_spoken_of(graph: dict[str, object]) -> None:
    with pytest.raises(ConfigurationError, match="got 'fork'; mend the scene reader"):
        SceneGraph(THINGS, **graph)  # type: ignore[arg-type]

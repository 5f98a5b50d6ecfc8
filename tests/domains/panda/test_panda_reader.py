"""The reader finds in pictures what the simulator put on the table; only pixels go between."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from simulated_arms import why_no_pictures

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.panda import colours, scene_reader, table_map
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.scene_reader import read_panda_scene
from skillwrapper.domains.panda.states import PandaState
from skillwrapper.embedded.scene_graph import SceneGraph
from skillwrapper.errors import PictureError
from skillwrapper.world.capabilities import Enumerable, require


def facts(graph: SceneGraph) -> dict[str, object]:
    """All that a reader says, without boxes."""
    return {
        "seen": {thing.name for thing in graph.things},
        "relations": {name: set(pairs) for name, pairs in graph.relations.items()},
        "attributes": {name: dict(values) for name, values in graph.attributes.items()},
    }


def true_facts(state: PandaState, names: set[str]) -> dict[str, object]:
    return {
        "seen": names,
        "relations": {
            "held": {(state.held, "robot")} if state.held else set(),
            "on": {(state.stacked, "plate")} if state.stacked else set(),
        },
        "attributes": {
            **({"plate": {"dirty": state.dirty}} if "plate" in names else {}),
            **({"mug": {"full": state.full}} if "mug" in names else {}),
        },
    }


def check(environment: Enumerable, scene: str, seed: int, every: int) -> None:
    environment.reset(seed=seed, scene=scene)
    for state in environment.reachable_states()[seed % every :: every]:
        png = environment.set_state(state, seed=seed).picture(None).png
        expected = true_facts(state, set(environment.scene.names))
        assert facts(read_panda_scene(png)) == expected, (scene, seed, state)


@pytest.fixture(autouse=True)
def _pictures() -> None:
    if why_no_pictures():
        pytest.skip(why_no_pictures())


def test_reads_states_with_everything() -> None:
    check(PandaEnvironment(), "table", 1, every=3)


@pytest.mark.parametrize("scene", ["pouring", "wiping", "stacking"])
def test_reads_scenes_with_some_of_the_things(scene: str) -> None:
    check(PandaEnvironment(), scene, 2, every=2)


@pytest.mark.parametrize("drawing", ["side", "dim"])
def test_reads_other_cameras_and_light(drawing: str) -> None:
    made = find_domain(f"panda@{drawing}").make_environment()
    check(require(made, Enumerable, "a test"), "table", 3, every=9)


def test_what_shows_something_else_is_refused() -> None:
    kitchen = find_domain("burger").make_environment().reset(seed=0)
    with pytest.raises(PictureError, match="no such table"):
        read_panda_scene(kitchen.picture(None).png)


def test_what_is_no_picture_is_refused() -> None:
    with pytest.raises(PictureError):
        read_panda_scene(b"no picture")


@pytest.mark.parametrize("module", [colours, scene_reader, table_map])
def test_it_knows_nothing_of_the_simulator(module: object) -> None:
    """Only names, cameras and colours are shared with what draws."""
    tree = ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8"))  # type: ignore[attr-defined]
    imported = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.module}
    mine = {name for name in imported if name.startswith("skillwrapper.domains")}
    allowed = {"cameras", "colours", "states", "table_map"}
    shared = {f"skillwrapper.domains.tabletop.{name}" for name in ("cameras", "colours", "views")}
    assert mine <= {f"skillwrapper.domains.panda.{name}" for name in allowed} | shared

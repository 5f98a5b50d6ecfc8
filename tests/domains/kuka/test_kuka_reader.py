"""The reader finds in pictures what the simulator put on the table; only pixels go between."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from simulated_arms import why_no_pictures

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.kuka import colours, scene_reader
from skillwrapper.domains.kuka.cameras import CAMERAS
from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.scene_reader import read_kuka_scene
from skillwrapper.domains.kuka.states import CLEAN, COATED, IN_HAND, IN_HOLDER, KukaState
from skillwrapper.errors import PictureError

HANDS = {"left": "jar", "right": "knife"}


def true_facts(state: KukaState) -> dict[str, object]:
    held = {"jar": state.jar_held, "knife": state.knife == IN_HAND}
    return {
        "seen": {"robot", "jar", "knife", "bread", "holder"},
        "held": {(name, "robot") for name, is_held in held.items() if is_held},
        "in": {("knife", "holder")} if state.knife == IN_HOLDER else set(),
        "robot": {f"{side}_hand_full": held[thing] for side, thing in HANDS.items()},
        "jar": {"open": state.opened},
        "knife": {"coated": state.blade == COATED, "smeared": state.blade != CLEAN},
        "bread": {"spread": state.spread},
    }


def facts(png: bytes) -> dict[str, object]:
    """All that the reader says, without boxes."""
    graph = read_kuka_scene(png)
    return {
        "seen": {thing.name for thing in graph.things},
        **{name: set(pairs) for name, pairs in graph.relations.items()},
        **{name: dict(values) for name, values in graph.attributes.items()},
    }


@pytest.mark.parametrize("camera", list(CAMERAS))
def test_reads_every_state_from_every_camera(camera: str) -> None:
    if why_no_pictures():
        pytest.skip(why_no_pictures())
    environment = KukaEnvironment(camera=camera)
    environment.reset(seed=1)
    for number, state in enumerate(environment.reachable_states()):
        png = environment.set_state(state, seed=number % 3).picture(None).png
        assert facts(png) == true_facts(state), (number, state)


def test_what_shows_something_else_is_refused() -> None:
    kitchen = find_domain("burger").make_environment().reset(seed=0)
    with pytest.raises(PictureError, match="no such table"):
        read_kuka_scene(kitchen.picture(None).png)


@pytest.mark.parametrize("module", [colours, scene_reader])
def test_it_knows_nothing_of_the_simulator(module: object) -> None:
    """Only names, cameras and colours are shared with what draws."""
    tree = ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8"))  # type: ignore[attr-defined]
    imported = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.module}
    mine = {name for name in imported if name.startswith("skillwrapper.domains")}
    shared = {f"tabletop.{name}" for name in ("cameras", "colours", "poses", "views")}
    allowed = {"kuka.cameras", "kuka.colours", "kuka.states"} | shared
    assert mine <= {f"skillwrapper.domains.{name}" for name in allowed}

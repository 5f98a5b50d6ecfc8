"""The example that users copy: it keeps all rules, is read without error and learned exactly."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import PictureError
from skillwrapper.world import Enumerable
from skillwrapper.world.capabilities import require
from skillwrapper.world.conformance import check_environment

FOLDER = Path(__file__).parents[2] / "examples" / "greenhouse"
PACKAGE = find_domain(str(FOLDER))


def test_it_keeps_every_rule_of_a_simulator() -> None:
    check_environment(PACKAGE.make_environment, steps=20, sample=5)


@pytest.mark.parametrize("scene", list(PACKAGE.domain.scenes))
@pytest.mark.parametrize("layout", [0, 1, 2])
def test_every_state_is_read_as_it_is(scene: str, layout: int) -> None:
    world = require(PACKAGE.make_environment(), Enumerable, "listing states")
    world.reset(seed=layout, scene=scene)
    assert PACKAGE.scene_reader is not None
    for state in world.reachable_states():
        (picture,) = world.set_state(state).pictures
        seen = PACKAGE.scene_reader(picture.png)
        bells = [thing.name for thing in seen.things if thing.kind == "bell"]
        assert {thing.name for thing in seen.things} == set(world.scene.names)
        assert seen.relations["on"] == {(bell, pot) for pot, bell in state.covered}
        assert seen.relations["held"] == {
            (bell, "gardener") for bell in bells if state.is_held(bell)
        }
        assert seen.attributes == {
            pot: {"wet": pot in state.wet, "trimmed": pot in state.trimmed}
            for pot in world.scene.names
            if pot.endswith("_pot")
        }


def test_pictures_of_something_else_are_left_to_others() -> None:
    kitchen = find_domain("burger").make_environment()
    assert PACKAGE.scene_reader is not None
    for png in (b"no picture", kitchen.reset(seed=0).pictures[0].png):
        with pytest.raises(PictureError, match="expected"):
            PACKAGE.scene_reader(png)


def test_it_is_learned_exactly_with_the_defaults(tmp_path: Path) -> None:
    def run(*arguments: str) -> str:
        result = CliRunner().invoke(app, arguments)
        assert result.exit_code == 0, result.output
        return result.stdout

    run("learn", str(FOLDER), "--out", str(tmp_path / "run"))
    found = json.loads(run("verify", str(tmp_path / "run"), "--json"))
    assert set(found["scenes"]) == {"bench", "window"}
    for part in (found, *found["scenes"].values()):
        assert (part["precision"], part["effect_accuracy"]) == (1.0, 1.0)
        assert part["recall"] > 0.5

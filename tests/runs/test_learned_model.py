"""Using a learned model: reading pictures of one camera or several, planning, predicting."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lamps import DOMAIN_YAML, LampAssistant, LampEnvironment
from PIL import Image
from scripted import ScriptedModel
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.errors import ConfigurationError, GoalError, UnknownNameError
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.grounding import UNKNOWN
from skillwrapper.planning.result import PlanningStatus
from skillwrapper.runs import model_sessions
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm
from skillwrapper.runs.archive import ArchiveWriter, make_archive
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.runs.settings import ModelSettings, RunSettings
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.world import Domain, load_domain

SETTINGS = RunSettings(
    domain="lamps",
    iterations=3,
    exploration=ExplorationSettings(budget=8, least_length=8, candidates=3),
    model=ModelSettings(name="openai:scripted"),
)
SCENES = "scenes:\n  shop: [hand, left, right]\n  desk: [hand, left]\n"
_ATOM = re.compile(r"\w+\([\w, ]*\)")


@pytest.fixture(scope="module")
def domain(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    path = tmp_path_factory.mktemp("domain") / "lamps.yaml"
    path.write_text(DOMAIN_YAML + SCENES)
    return load_domain(path)


@pytest.fixture(scope="module")
def run(domain: Domain, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run that has learned when lamps can be lit."""
    path = tmp_path_factory.mktemp("run") / "run"
    archive = make_archive(path, SETTINGS, domain)
    plain = replace(domain, declared_scenes=domain.declared_scenes[:1])
    environment = LampEnvironment(plain)
    LearningAlgorithm(
        SETTINGS, environment, LampAssistant(), [ArchiveWriter(archive)], EarlierRun()
    ).run()
    return path


def picture(path: Path, *lit: str) -> Path:
    """A picture whose colour says what shines: red the left lamp, green the right one."""
    colour = (255 * ("left" in lit), 255 * ("right" in lit), 0)
    Image.new("RGB", (4, 4), colour).save(path)
    return path


def read(request: ModelRequest) -> str:
    """Reads every picture that is shown, whichever camera took it."""
    if request.role is Role.SUMMARISE:
        return "\n".join(re.findall(r"^\w+\(.*\) is (?:true|false)$", request.prompt, re.M))
    shines = {"left": False, "right": False}
    for shown in request.pictures:
        red, green, _ = Image.open(io.BytesIO(shown.png)).convert("RGB").getpixel((0, 0))
        shines["left"] |= red > 0
        shines["right"] |= green > 0
    said = {
        "lit(left)": shines["left"],
        "lit(right)": shines["right"],
        "power()": not any(shines.values()),
        "round(left)": True,
        "round(right)": True,
    }
    asked = set(_ATOM.findall(request.prompt))
    lines = (f"{a} is {'true' if v else 'false'}" for a, v in said.items() if a in asked)
    return "the lamps: left and right\n" + "\n".join(lines)


@pytest.fixture
def model() -> ScriptedModel:
    return ScriptedModel(read)


def test_reading_says_what_is_true(run: Path, model: ScriptedModel, tmp_path: Path) -> None:
    with LearnedModel.load(run, model=model) as learned:
        state = learned.read(picture(tmp_path / "a.png", "left"))
        assert state["lit(left)"] is True
        assert state["lit(right)"] is False
        assert "lit(left)" in map(str, state.true)
        assert dict(state)["lit(left)"] is True
        assert learned.read(picture(tmp_path / "a.png", "left")) == state
        assert learned.calls.answered == len(model.requests)
        with pytest.raises(UnknownNameError, match=r"unknown atom 'lit\(letf\)'; did you mean"):
            state["lit(letf)"]


def test_every_camera_is_shown_under_its_name(
    run: Path, model: ScriptedModel, tmp_path: Path
) -> None:
    front, top = picture(tmp_path / "f.png", "left"), picture(tmp_path / "t.png", "right")
    with LearnedModel.load(run, model=model) as learned:
        state = learned.read({"front": front, "top": str(top)})
    assert (state["lit(left)"], state["lit(right)"]) == (True, True)
    shown = {tuple(p.camera for p in r.pictures) for r in model.requests if r.pictures}
    assert shown == {("front", "top")}


def test_states_are_over_the_objects_of_a_scene(
    run: Path, model: ScriptedModel, tmp_path: Path
) -> None:
    with LearnedModel.load(run, model=model) as learned:
        state = learned.read(picture(tmp_path / "a.png"), scene="desk")
        assert "lit(left)" in state
        assert "lit(right)" not in list(state)
        with pytest.raises(UnknownNameError, match="unknown object 'right'"):
            learned.expected(state, "Light(hand, right)")
        with pytest.raises(UnknownNameError, match="unknown scene 'cellar'"):
            learned.read(picture(tmp_path / "a.png"), scene="cellar")


def test_plans_are_over_the_objects_of_the_scene(
    run: Path, model: ScriptedModel, tmp_path: Path
) -> None:
    dark = picture(tmp_path / "dark.png")
    with LearnedModel.load(run, model=model) as learned:
        found = learned.plan(dark, "(lit left)", scene="desk", plans=1)
        assert found.status is PlanningStatus.SOLVED
        assert [str(step) for step in found.plans[0]] == ["Light(hand, left)"]
        goal = learned.goal(picture(tmp_path / "lit.png", "right"), positive_only=True)
        other = learned.plan(learned.read(dark), goal, plans=1)
        assert [str(step) for step in other.plans[0]] == ["Light(hand, right)"]
        with pytest.raises(UnknownNameError, match="unknown object 'right'"):
            learned.plan(dark, "(lit right)", scene="desk")


def test_what_is_expected_of_a_skill(run: Path, model: ScriptedModel, tmp_path: Path) -> None:
    with LearnedModel.load(run, model=model) as learned:
        dark = learned.read(picture(tmp_path / "dark.png"))
        lit = learned.expected(dark, "Light(hand, left)")
        assert (lit.succeeds, lit.state["lit(left)"]) == (True, True)
        again = learned.expected(lit.state, "Light(hand, right)")
        assert (again.succeeds, again.state) == (False, lit.state)
        blurred = AbstractState(dark.scene, dark.space, np.full_like(dark.labels, UNKNOWN))
        assert learned.expected(blurred, "PutOut(hand, left)").succeeds is None
        with pytest.raises(ConfigurationError, match="expected a skill like"):
            learned.expected(dark, "Light")


@pytest.fixture
def scripted_commands(monkeypatch: pytest.MonkeyPatch) -> ScriptedModel:
    """Commands whose models are all the scripted one."""
    model = ScriptedModel(read)
    monkeypatch.setattr(model_sessions, "open_model", lambda *_: model)
    return model


def test_the_command_takes_a_picture_for_each_camera(
    run: Path, scripted_commands: ScriptedModel, tmp_path: Path
) -> None:
    dark, lit = picture(tmp_path / "dark.png"), picture(tmp_path / "lit.png", "left")
    done = CliRunner().invoke(
        app,
        ["plan", str(run), "--init", f"front={dark}", "--init", f"top={dark}", "--scene", "desk",
         "--goal", f"front={lit}", "--goal", f"top={dark}", "--goal", "(lit left)", "--json"],
    )  # fmt: skip
    assert done.exit_code == 0, done.exception
    assert json.loads(done.stdout)["plans"][0] == ["Light(hand, left)"]
    cameras = {tuple(p.camera for p in r.pictures) for r in scripted_commands.requests}
    assert cameras - {()} == {("front", "top")}


def test_goals_that_contradict_each_other_are_refused(
    run: Path, scripted_commands: ScriptedModel, tmp_path: Path
) -> None:
    dark = picture(tmp_path / "dark.png")
    with pytest.raises(GoalError, match="cannot hold together"):
        CliRunner().invoke(
            app,
            ["plan", str(run), "--init", str(dark), "--goal", str(dark), "--goal", "(lit left)"],
            catch_exceptions=False,
        )

"""``export``: files that other planners take, and the way back to skills."""

from __future__ import annotations

import json
import runpy
import sys
from pathlib import Path

import pytest
from command_line import command
from cubes import learn_cubes

from skillwrapper.errors import UnknownNameError
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world import SkillInstance


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short run in the world of a new project."""
    return learn_cubes(tmp_path_factory.mktemp("exported"))


def picture(run: Path) -> Path:
    return min(run.glob("images/*.png"))


@pytest.mark.parametrize("to", ["pddl", "up", "plansys2"])
def test_files_for_each_kind_of_planner(
    to: str, run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    seen = picture(run)
    assert not command(
        "export", run, "--to", to, "--init", seen, "--goal", seen, "--out", tmp_path, "--json"
    )
    told = json.loads(capsys.readouterr().out)
    assert {Path(name).name for name in told["files"]} == {
        "domain.pddl", "problem.pddl", "skills.json"
    }  # fmt: skip
    assert json.loads((tmp_path / "skills.json").read_text())["actions"] == told["actions"]
    assert ("(not (" in (tmp_path / "problem.pddl").read_text()) == (to != "plansys2")
    if to == "up":
        problem = runpy.run_path(str(tmp_path / "problem.py"))["problem"]
        assert len(problem.actions) == len(told["actions"])


def test_several_goals_are_several_problems_without_disjunction(run: Path) -> None:
    with LearnedModel.load(run) as learned:
        state = learned.read(picture(run))
        first, second = list(state)[:2]
        either = f"(or {first} {second})"
        assert len(learned.export("plansys2", state, either).problems) == 2
        (problem,) = learned.export("pddl", state, either).problems
        assert "(or (and (" in problem


def test_steps_of_plans_are_skills_again(run: Path) -> None:
    with LearnedModel.load(run) as learned:
        table = learned.export("pddl").table
        row = table.rows[0]
        objects = list(table.objects)[: len(row.arguments)]
        instance = table.instance(row.action.upper(), [*objects, "whatever"])
        assert instance == SkillInstance(row.skill, tuple(table.objects[o] for o in objects))
        with pytest.raises(UnknownNameError, match="unknown action 'fly'"):
            table.instance("fly", [])


def test_start_without_goal(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command("export", run, "--to", "pddl", "--init", picture(run)) == 2
    assert "expected both --init and --goal" in capsys.readouterr().err


def test_unified_planning_is_missing(
    run: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "unified_planning.io", None)
    seen = picture(run)
    assert command("export", run, "--to", "up", "--init", seen, "--goal", seen) == 2
    assert "pip install 'skillwrapper[up]'" in capsys.readouterr().err

"""Every command works for a domain that lies in a folder of one's own (tests/support/cup_world)."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable, Iterator
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

import pytest
from command_line import command

from skillwrapper.planning.kstar import KStar
from skillwrapper.planning.planner import Planner
from skillwrapper.runs import learned_model

WORLD = Path(__file__).parents[1] / "support" / "cup_world"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The working directory, with the domain in ``cups`` and what was learned of it in ``run``."""
    path = tmp_path_factory.mktemp("own")
    shutil.copytree(WORLD, path / "cups", ignore=shutil.ignore_patterns("__pycache__"))
    before = Path.cwd()
    os.chdir(path)
    assert command("learn", "cups", "--out", "run", "--iterations", "4") == 0
    yield path
    os.chdir(before)


Printed = Callable[..., Any]


@pytest.fixture
def printed(folder: Path, capsys: pytest.CaptureFixture[str]) -> Printed:
    """Runs a command that prints JSON."""

    def run(*words: str | Path) -> Any:
        capsys.readouterr()
        assert command(*words, "--json") == 0
        return json.loads(capsys.readouterr().out)

    return run


def test_domain_is_shown_with_its_scenes(printed: Printed) -> None:
    shown = printed("domain", "cups")
    assert shown["scenes"] == {"kitchen": ["hand", "mug", "glass"], "desk": ["hand", "mug"]}
    assert shown["capabilities"] == ["settable", "simulable", "enumerable", "replayable"]
    assert shown["abstract_states"] == {"kitchen": 4, "desk": 2}
    assert shown["skill_instances"] == 4
    desk = printed("domain", "./cups/domain.yaml", "--scene", "desk")
    assert (desk["abstract_states"], desk["skill_instances"]) == ({"desk": 2}, 2)
    assert list(desk["objects"]) == ["hand", "mug"]
    assert command("domain", "cups") == 0


def test_rules_are_checked(
    printed: Printed, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert printed("check", "cups", "--steps", "5")["kept_rules_of"] == "simulator"
    shutil.copytree(WORLD, tmp_path / "cups")
    path = tmp_path / "cups" / "robot.py"
    drifting = path.read_text().replace("state, layout)}", "state, next(LOOKS))}")
    path.write_text(f"import itertools\n{drifting}\n\nLOOKS = itertools.count()\n")
    assert command("check", tmp_path / "cups", "--steps", "5") == 1
    assert "error: observe: the first observe() after reset: exp" in capsys.readouterr().err


def test_what_was_learned_is_exact(printed: Printed) -> None:
    found = printed("verify", "run")
    assert (found["precision"], found["recall"], found["effect_accuracy"]) == (1, 1, 1)


def test_both_scenes_were_learned_in(folder: Path) -> None:
    episodes = sorted((folder / "run" / "episodes").glob("*.jsonl"))
    scenes = [json.loads(path.read_text().splitlines()[0])["scene"]["name"] for path in episodes]
    # One scene an iteration, in one episode or several.
    assert [name for name, _ in groupby(scenes)] == ["kitchen", "desk", "kitchen", "desk"]


def test_pictures_of_several_cameras_are_planned_from(printed: Printed) -> None:
    """A picture is read as the one of its camera, in the scene that is named."""
    assert command("render", "cups", "--scene", "desk", "--out", "start.png") == 0
    fill = ("--do", "Fill(hand, mug)")
    done = printed(
        "render", "cups", "--scene", "desk", *fill, "--camera", "top", "--out", "end.png"
    )
    assert done["skills"] == [{"skill": "Fill(hand, mug)", "success": True}]
    pictures = ("--init", "top=start.png", "--goal", "top=end.png")
    found = printed("plan", "run", *pictures, "--scene", "desk", "--plans", "1")
    assert (found["status"], found["plans"]) == ("solved", [["Fill(hand, mug)"]])


def test_plans_are_executed_in_a_scene(printed: Printed) -> None:
    goal = ("--goal", "top=end.png", "--scene", "desk")
    assert command("render", "cups", *goal[2:], "--do", "Fill(hand, mug)", "--out", "end.png") == 0
    assert printed("solve", "run", *goal)["solved"]
    named = printed("show", "run")["predicates"][0]["name"]
    assert printed("solve", "run", "--goal", f"({named} mug)")["solved"]


def test_runs_are_shown_and_reported(folder: Path) -> None:
    for words in (("show", "run"), ("report", "run"), ("calls", "run")):
        assert command(*words) == 0
    assert (folder / "run" / "report.html").is_file()


def test_problems_are_made(printed: Printed) -> None:
    made = printed("problems", "cups", "--easy", "1", "--hard", "0", "--impossible", "0")
    assert [problem["class"] for problem in made["problems"]] == ["easy"]


def test_a_run_goes_on_from_anywhere(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir("/")
    words = ("--out", folder / "run", "--iterations", "4")
    assert command("learn", folder / "cups", *words) == 0
    assert command("verify", folder / "run") == 0


def test_a_run_is_read_without_its_domain(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What only looks at the run goes on working; what needs the robot says what is missing."""
    (folder / "cups").rename(folder / "elsewhere")
    try:
        assert command("show", "run") == 0
        assert command("report", "run") == 0
        capsys.readouterr()
        for words in (("verify", "run"), ("solve", "run", "--goal", "(not_full mug)")):
            assert command(*words) == 2
            told = capsys.readouterr().err
            assert f"{folder / 'cups'}: no such file or folder" in told
            assert "a run finds its domain by 'domain' in its config.yaml" in told
    finally:
        (folder / "elsewhere").rename(folder / "cups")


def test_a_domain_of_a_module_is_learned(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "cups_of_tea.py").write_text(
        "from pathlib import Path\n\ndomain = Path(__file__).with_name('cups')\n"
    )
    monkeypatch.syspath_prepend(str(folder))
    words = ("--out", "of_module", "--iterations", "1")
    assert command("learn", "cups_of_tea:domain", *words) == 0
    assert "domain: cups_of_tea:domain" in (folder / "of_module" / "config.yaml").read_text()
    assert command("verify", "of_module") == 0


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("domain.yaml", "[hand, mug]", "[hand, mgu]", "unknown object in scene 'desk' 'mgu'"),
        ("domain.yaml", "robot.py:CupWorld", "robot.py:TeaWorld", "unknown name in robot.py 'TeaW"),
        ("robot.py", "def draw(", "def paint(", "robot.py:CupWorld lacks draw"),
        ("robot.py", "import draw", "import paint", "robot.py:3: ImportError: cannot import name"),
        ("reader.py", "def read_cups", "def read", "unknown name in reader.py 'read_cups'"),
    ],
)
def test_mistakes_end_with_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], file: str, old: str, new: str, message: str
) -> None:
    shutil.copytree(WORLD, tmp_path / "cups", ignore=shutil.ignore_patterns("__pycache__"))
    path = tmp_path / "cups" / file
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))
    assert command("learn", tmp_path / "cups", "--out", tmp_path / "run") == 2
    told = capsys.readouterr().err
    assert message in told
    assert told.count("\n") == 1
    assert not (tmp_path / "run").exists()


def test_a_folder_without_a_domain_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words in (("domain",), ("learn", "--out", tmp_path / "run"), ("render", "--out", "x.png")):
        assert command(words[0], tmp_path, *words[1:]) == 2
        told = capsys.readouterr().err
        assert (
            told
            == f"error: {tmp_path}: expected a domain.yaml in the folder of a domain, got none\n"
        )


BROKEN = {
    "exit 0": "ended as if it had found plans, and wrote none",
    "echo out of memory; exit 22": "ran out of memory",
    "kill -SEGV $$": "was ended by SIGSEGV",
    "echo '[]' > plans.json": "wrote no plans that can be read",
    "": "K* is not installed; pip install kstar-planner",
}


@pytest.mark.parametrize("script", BROKEN, ids=BROKEN.get)
def test_a_broken_or_missing_planner_is_told(
    folder: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    script: str,
) -> None:
    program = tmp_path / "planner"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    planner = partial(Planner, engine=KStar(program if script else None))
    monkeypatch.setattr(learned_model, "Planner", planner)
    desk = ("--scene", "desk")
    start, goal = tmp_path / "start.png", tmp_path / "goal.png"
    assert command("render", "cups", *desk, "--out", start) == 0
    assert command("render", "cups", *desk, "--do", "Fill(hand, mug)", "--out", goal) == 0
    wanted = ("--goal", f"top={goal}", *desk)
    for words in (("plan", "run", "--init", f"top={start}", *wanted), ("solve", "run", *wanted)):
        capsys.readouterr()
        assert command(*words, "--json") == 1
        said = json.loads(capsys.readouterr().out)
        assert (said["status"], said["plans"]) == ("error", [])
        assert BROKEN[script] in said["error"]
        assert command(*words) == 1
        printed = capsys.readouterr()
        assert BROKEN[script] in " ".join((printed.out + printed.err).split())
        assert "Traceback" not in printed.err

"""``explain`` and ``diff``: what a model rests on, and what another has otherwise."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest
from command_line import command

from skillwrapper.domains.starting import start_project
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two runs in the world of a new project, one longer than the other."""
    folder = tmp_path_factory.mktemp("explained")
    start_project(folder / "cubes")
    settings = {"domain": str(folder / "cubes"), "exploration.budget": 12}
    learn({**settings, "iterations": 3}, folder / "run")
    learn({**settings, "iterations": 1, "seed": 3}, folder / "short")
    return folder


@pytest.fixture(scope="module")
def operator(folder: Path) -> str:
    return RunArchive.open(folder / "run").latest().model.operators[0].name


def explained(capsys: pytest.CaptureFixture[str], *words: str | Path) -> dict[str, object]:
    assert command("explain", *words, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert isinstance(found, dict)
    return found


def test_every_literal_is_explained(
    folder: Path, operator: str, capsys: pytest.CaptureFixture[str]
) -> None:
    run = folder / "run"
    found = explained(capsys, run, operator.lower())
    learned = next(o for o in RunArchive.open(run).latest().model.operators if o.name == operator)
    told = {one["literal"]: one for one in found["literals"]}
    assert {str(c) for c in (*learned.preconditions, *learned.absences)} <= told.keys()
    assert {f"makes {atom}" for atom in learned.add_effects} <= told.keys()
    untested = {str(c) for c in RunArchive.open(run).latest().untested(learned)}
    for name, one in told.items():
        if one["standing"] == "open":
            assert name in untested or name.startswith("types ")
            assert not one["rests_on"]
            assert "to decide it, run" in one["without"]
        if one["standing"] == "proven" and one["rests_on"]:
            assert name not in untested
            assert "it would apply to" in one["without"]
        for transition in one["rests_on"]:
            assert all(Path(file).is_file() for file in transition["before"] + transition["after"])
    assert found["successes"]
    assert all(one["success"] for one in found["successes"])


def test_the_evidence_of_one_literal(
    folder: Path, operator: str, capsys: pytest.CaptureFixture[str]
) -> None:
    found = explained(capsys, folder / "run", operator)
    effect = next(one for one in found["literals"] if one["standing"] == "effect")
    assert effect["rests_on"] == found["successes"]
    assert command("explain", folder / "run", operator, effect["literal"].replace(" ", "")) == 0
    printed = capsys.readouterr().out
    assert printed.count(".png ->") == len(found["successes"])


def test_what_is_not_there(folder: Path, operator: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert command("explain", folder / "run", "Fly_1") == 2
    assert "unknown operator 'Fly_1'; did you mean" in capsys.readouterr().err
    assert command("explain", folder / "run", operator, "blue(?sky)") == 2
    assert "unknown literal 'blue(?sky)'" in capsys.readouterr().err


def test_a_run_does_not_differ_from_itself(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("diff", folder / "run", folder / "run") == 0
    assert capsys.readouterr().out.count("the same") == 3


def test_runs_that_differ(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command("diff", folder / "run", folder / "short", "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert "- episodes: 3" in found["evidence"]
    assert "+ episodes: 1" in found["evidence"]
    assert command("diff", folder / "short", folder / "run", "--json") == 0
    back = json.loads(capsys.readouterr().out)
    turned = sorted(line.translate(str.maketrans("+-", "-+", "")) for line in back["evidence"])
    assert turned == sorted(found["evidence"])


def test_words_that_mean_the_same_are_matched(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The same run, with one predicate under another name."""
    run = Path(shutil.copytree(folder / "run", tmp_path / "renamed"))
    latest = RunArchive.open(run).latest()
    old = min(literal.atom.predicate for literal in latest.model.operators[0].preconditions)
    for file in (latest.folder / "model.json", latest.folder / "truth_table.csv"):
        file.write_text(re.sub(rf"\b{old}\b", "otherwise", file.read_text()))
    assert command("diff", folder / "run", run, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert any("otherwise(" in line and "is the same as" in line for line in found["vocabulary"])
    assert found["operators"] == found["evidence"] == []

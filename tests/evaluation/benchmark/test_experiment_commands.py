"""The commands ``problems`` and ``experiment``, from files to tables."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner, Result

from skillwrapper.cli import experiments, problems
from skillwrapper.errors import ConfigurationError, RunFolderError

FILE = """\
name: tiny
methods: [expert]
problems: {easy: 1, hard: 0, impossible: 1}
"""


def invoke(*arguments: str | Path) -> Result:
    app = typer.Typer()
    experiments.register(app)
    problems.register(app)
    return CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=False)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished experiment."""
    place = tmp_path_factory.mktemp("tiny")
    (place / "tiny.yaml").write_text(FILE)
    done = invoke("experiment", "run", place / "tiny.yaml", "--out", place / "out", "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.stdout)
    assert (data["finished"], data["failed"]) == (1, {})
    made = dict(data["made"])
    assert made["Command"].startswith("`skillwrapper experiment run")
    assert made["Code"].startswith("skillwrapper ")
    return place / "out"


def test_table_in_every_format(folder: Path) -> None:
    data = json.loads(invoke("experiment", "table", folder, "--format", "json").stdout)
    assert data["methods"][0]["easy"] == {"mean": 100.0, "std": 0.0}
    assert data["methods"][0]["impossible"]["mean"] == 100.0
    assert "Expert Operators" in invoke("experiment", "table", folder).stdout
    assert (
        "| Expert Operators" in invoke("experiment", "table", folder, "--format", "markdown").stdout
    )
    assert r"\toprule" in invoke("experiment", "table", folder, "--format", "latex").stdout
    assert invoke("experiment", "table", folder, "--format", "csv").stdout.startswith("method,")


def test_plot(folder: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    data = json.loads(invoke("experiment", "plot", folder, "--out", tmp_path, "--json").stdout)
    assert [Path(p).name for p in data["plots"]] == ["problems-burger-none.png"]
    assert Path(data["plots"][0]).is_file()


def test_run_again_runs_nothing(folder: Path) -> None:
    file = folder.parent / "tiny.yaml"
    again = invoke("experiment", "run", file, "--out", folder)
    assert again.exit_code == 0
    assert "1 of 1 cells are finished" in again.stdout


def test_failed_cell_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(folder: object, cell: object) -> None:
        raise ConfigurationError("something is wrong")

    monkeypatch.setattr("skillwrapper.evaluation.benchmark.running._run", fail)
    (tmp_path / "tiny.yaml").write_text(FILE)
    done = invoke("experiment", "run", tmp_path / "tiny.yaml", "--out", tmp_path / "out", "--json")
    assert done.exit_code == 1
    assert json.loads(done.stdout)["failed"] == {"expert-burger-s0-none": "something is wrong"}
    with pytest.raises(ConfigurationError, match="expected a finished cell, found none"):
        invoke("experiment", "plot", tmp_path / "out")


def test_folder_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(RunFolderError, match="expected the folder of an experiment"):
        invoke("experiment", "table", tmp_path)


def test_problems(tmp_path: Path) -> None:
    out = tmp_path / "mine.yaml"
    options = ("--easy", "2", "--hard", "1", "--impossible", "1", "--seed", "4", "--out", out)
    data = json.loads(invoke("problems", "burger", *options, "--json").stdout)
    assert [p["class"] for p in data["problems"]] == ["easy", "easy", "hard", "impossible"]
    assert out.is_file()
    with pytest.raises(ConfigurationError, match="exists already"):
        invoke("problems", "burger", *options)
    shown = invoke("problems", "burger", *options[:-2])
    assert "impossible-01" in shown.stdout

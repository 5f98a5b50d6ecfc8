"""The list of settings, for people and for programs; and settings that are given in a file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.errors import UserError
from skillwrapper.runs.archive import RunArchive


def test_every_setting_is_listed_once() -> None:
    done = CliRunner().invoke(app, ["settings", "--json"])
    listed = {one["name"]: one for one in json.loads(done.stdout)}
    assert len(listed) == len(json.loads(done.stdout)) > 50
    attempts = listed["learning.attempts"]
    assert attempts["default"] == 3
    assert attempts["unit"] == "questions"
    assert attempts["expected"] == "whole number from 1"
    assert attempts["meaning"]
    assert (attempts["of"], attempts["may_change_on_resume"]) == ("run", False)
    assert listed["calls.max_cost"]["may_change_on_resume"]
    assert listed["planner.plans"]["of"] == "experiment"
    text = CliRunner().invoke(app, ["settings"]).stdout
    assert all(name in text for name in listed)


def learn(*arguments: object) -> None:
    CliRunner().invoke(app, ["learn", *map(str, arguments)], catch_exceptions=False)


def test_a_file_an_option_and_set_over_each_other(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("domain: burger\niterations: 1\nseed: 5\nexploration: {budget: 4}\n")
    more = ("--seed", 6, "--set", "learning.attempts=2")
    learn("--config", file, *more, "--out", tmp_path / "run")
    settings = RunArchive.open(tmp_path / "run").settings()
    assert (settings.domain, settings.iterations, settings.seed) == ("burger", 1, 6)
    assert (settings.exploration.budget, settings.learning.attempts) == (4, 2)
    learn("--config", tmp_path / "run" / "config.yaml", "--out", tmp_path / "again")
    assert RunArchive.open(tmp_path / "again").settings() == settings
    assert (tmp_path / "again" / "model" / "model.json").read_bytes() == (
        tmp_path / "run" / "model" / "model.json"
    ).read_bytes()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("burger", "--seed", "-1"), "--seed: 'seed': expected greater than or equal to 0, got -1"),
        (("burger", "--set", "sead=1"), "--set: unknown setting 'sead'; did you mean 'seed'?"),
        (("--config", "nothing.yaml"), "nothing.yaml: cannot be read (No such file or directory)"),
        ((), "expected a value for 'domain', got none"),
        (("burgr",), "unknown domain 'burgr'; did you mean 'burger'?"),
        (("burger", "--explore", "planed"), "unknown explorer 'planed'; did you mean 'planned'?"),
        (("burger", "--set", "learning.learner=x"), "unknown learner 'x'"),
        (("burger", "--set", "scenes=[attic]"), "unknown scene 'attic'"),
    ],
)
def test_mistakes_leave_no_folder(tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    with pytest.raises(UserError) as raised:
        learn(*arguments, "--out", tmp_path / "run")
    assert message in str(raised.value)
    assert not (tmp_path / "run").exists()

"""Runs and experiments on media that cannot be written to: to be looked at, not to go on."""

from __future__ import annotations

import ctypes
import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment
from skillwrapper.runs.launch import learn

_DROP_CAPABILITY, _OVERRIDE_RIGHTS = 24, 1


def _obey_rights() -> None:
    """Let what is started next obey the rights of files, also if it is started by root."""
    ctypes.CDLL(None).prctl(_DROP_CAPABILITY, _OVERRIDE_RIGHTS, 0, 0, 0)


@pytest.fixture(scope="module")
def media(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A run and an experiment that ended in another place."""
    path = tmp_path_factory.mktemp("media")
    learn({"domain": "burger", "iterations": 1, "exploration.budget": 6}, path / "run")
    experiment = Experiment(name="x", methods=("expert",), domains=("burger",), seeds=(0,))
    ExperimentFolder.create_or_resume(path / "experiment", experiment)
    everything = [path, *path.rglob("*")]
    for one in everything:
        one.chmod(0o555 if one.is_dir() else 0o444)
    yield path
    for one in everything:
        one.chmod(0o755 if one.is_dir() else 0o644)


_COMMANDS = """
import json, sys
from typer.testing import CliRunner
from skillwrapper.cli.main import app
for line in json.loads(sys.argv[1]):
    done = CliRunner().invoke(app, line)
    print(json.dumps([done.exit_code, done.stdout, repr(done.exception)]))
"""


def commands(*lines: Sequence[object]) -> list[tuple[int, str, str]]:
    """Exit code, output and exception of each, all in one process that obeys the rights."""
    told = json.dumps([list(map(str, line)) for line in lines])
    done = subprocess.run(
        [sys.executable, "-c", _COMMANDS, told],
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        preexec_fn=_obey_rights,
        capture_output=True,
        text=True,
        check=True,
    )
    return [tuple(json.loads(line)) for line in done.stdout.splitlines()]


def test_it_can_be_looked_at_and_what_must_write_says_so(media: Path, tmp_path: Path) -> None:
    run, experiment, asked = media / "run", media / "experiment", tmp_path / "asked.yaml"
    asked.write_text("{name: x, methods: [expert], domains: [burger], seeds: [0]}")
    before, page = sorted(media.rglob("*")), tmp_path / "page.html"
    shown, called, reported, refused, learned, compared = commands(
        ("show", run),
        ("calls", run),
        ("report", run, "--out", page),
        ("report", run),
        ("learn", "burger", "--iterations", 2, "--budget", 6, "--out", run),
        ("experiment", "run", asked, "--out", experiment),
    )
    assert "certificate" in shown[1]
    assert "evaluate" in called[1]
    assert reported[0] == 0
    assert page.read_text().startswith("<!DOCTYPE html>")
    assert "FileNotWritableError" in refused[2]
    assert "report.html: cannot be written" in refused[2]
    assert "RunFolderError" in learned[2]
    assert "calls.sqlite: the call" in learned[2]
    assert "FileNotWritableError" in compared[2]  # a traceback about its lock, once
    assert "runs.jsonl: cannot be written" in compared[2]
    assert sorted(media.rglob("*")) == before

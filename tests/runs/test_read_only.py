"""Runs on media that cannot be written to: they can be looked at, and learning says so."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from skillwrapper.runs.launch import learn

_DROP_CAPABILITY, _OVERRIDE_RIGHTS = 24, 1


def _obey_rights() -> None:
    """Let what is started next obey the rights of files, also if it is started by root."""
    ctypes.CDLL(None).prctl(_DROP_CAPABILITY, _OVERRIDE_RIGHTS, 0, 0, 0)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    path = tmp_path_factory.mktemp("media") / "run"
    learn({"domain": "burger", "iterations": 1, "exploration.budget": 6}, path)
    everything = [path, *path.rglob("*")]
    for one in everything:
        one.chmod(0o555 if one.is_dir() else 0o444)
    yield path
    for one in everything:
        one.chmod(0o755 if one.is_dir() else 0o644)


def command(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "skillwrapper", *map(str, arguments)],
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        preexec_fn=_obey_rights,
        capture_output=True,
        text=True,
        check=False,
    )


def test_it_can_be_looked_at(run: Path, tmp_path: Path) -> None:
    assert "certificate" in command("show", run).stdout
    assert "evaluate" in command("calls", run).stdout
    page = tmp_path / "page.html"
    assert command("report", run, "--out", page).returncode == 0
    assert page.read_text().startswith("<!DOCTYPE html>")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("learn", "burger", "--iterations", 2, "--budget", 6, "--out"), "calls.sqlite: the call"),
        (("report",), "report.html: cannot be written"),
    ],
)
def test_what_must_write_says_so_in_one_sentence(
    run: Path, arguments: tuple[object, ...], message: str
) -> None:
    before = sorted(run.rglob("*"))
    done = command(*arguments, run)
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert sorted(run.rglob("*")) == before

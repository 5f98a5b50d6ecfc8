from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from skillwrapper.domains.starting import start_project
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn


@pytest.fixture(scope="session")
def learned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short run in the world of a new project."""
    folder = tmp_path_factory.mktemp("reviewed")
    start_project(folder / "cubes")
    settings = {"domain": str(folder / "cubes"), "iterations": 3, "exploration.budget": 12}
    learn(settings, folder / "run")
    return folder / "run"


@pytest.fixture
def run(learned: Path, tmp_path: Path) -> RunArchive:
    """A copy of it, to be corrected."""
    return RunArchive.open(Path(shutil.copytree(learned, tmp_path / "run")))

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from cubes import learn_cubes

from skillwrapper.runs.archive import RunArchive


@pytest.fixture(scope="session")
def learned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short run in the world of a new project."""
    return learn_cubes(tmp_path_factory.mktemp("reviewed"))


@pytest.fixture
def run(learned: Path, tmp_path: Path) -> RunArchive:
    """A copy of it, to be corrected."""
    return RunArchive.open(Path(shutil.copytree(learned, tmp_path / "run")))

from pathlib import Path

import pytest

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn
from skillwrapper.runs.settings import ModelSettings, RunSettings


@pytest.fixture(scope="session")
def run(tmp_path_factory: pytest.TempPathFactory) -> RunArchive:
    """A short, noisy run of the embedded model."""
    config = RunSettings(
        domain="burger",
        seed=2,
        iterations=3,
        exploration=ExplorationSettings(budget=14),
        learning=LearningSettings(attempts=1, candidates=1, threshold=0.9),
        model=ModelSettings(noise="gpt5"),
    )
    path = tmp_path_factory.mktemp("report") / "run"
    learn(config, path)
    return RunArchive.open(Path(path))

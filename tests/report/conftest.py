from pathlib import Path

import pytest

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.learn import learn
from skillwrapper.runs.settings import ModelSettings, RunSettings


@pytest.fixture(scope="session")
def run(tmp_path_factory: pytest.TempPathFactory) -> RunFolder:
    """A short, noisy run of the embedded model."""
    config = RunSettings(
        domain="burger",
        seed=2,
        iterations=3,
        exploration=ExplorationSettings(budget=20),
        learning=LearningSettings(attempts=1, candidates=1, threshold=0.9),
        model=ModelSettings(noise="gpt5"),
    )
    path = tmp_path_factory.mktemp("report") / "run"
    learn(config, path)
    return RunFolder.open(Path(path))

"""The folder of a run: made once, resumed with the same settings, never anything else's."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lamps import DOMAIN_YAML, domain_file, seen

from skillwrapper.errors import ConfigurationError, RunFolderError
from skillwrapper.files.writing import write_json
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world import Observation, Picture

CONFIG = RunSettings(domain="lamps", seed=3)


class CrashError(Exception):
    pass


@pytest.fixture
def lamps_yaml(tmp_path: Path) -> Path:
    return domain_file(tmp_path)


@pytest.fixture
def folder(tmp_path: Path, lamps_yaml: Path) -> RunFolder:
    return RunFolder.create_or_resume(tmp_path / "run", CONFIG, lamps_yaml)


def contents(path: Path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in path.rglob("*") if p.is_file()}


def test_a_new_folder_holds_what_was_asked_for(folder: RunFolder) -> None:
    assert folder.config() == CONFIG
    assert (folder.path / "domain.yaml").read_text() == DOMAIN_YAML
    assert set(contents(folder.path)) == {"config.yaml", "domain.yaml"}
    text = (folder.path / "config.yaml").read_text()
    assert all(word in text for word in ("made_with", "commit", "python", "numpy"))


def test_an_empty_folder_may_be_used(tmp_path: Path, lamps_yaml: Path) -> None:
    (tmp_path / "run").mkdir()
    assert RunFolder.create_or_resume(tmp_path / "run", CONFIG, lamps_yaml).config() == CONFIG


def test_the_same_settings_resume(folder: RunFolder, lamps_yaml: Path) -> None:
    lamps_yaml.write_text("changed since")
    before = contents(folder.path)
    more = CONFIG.model_copy(update={"iterations": 50})
    again = RunFolder.create_or_resume(folder.path, more, lamps_yaml)
    assert again == folder
    assert contents(folder.path) == before


def test_other_settings_are_refused(folder: RunFolder, lamps_yaml: Path) -> None:
    before = contents(folder.path)
    with pytest.raises(RunFolderError, match=r"other settings \(seed: 3 there, 4 now\)"):
        RunFolder.create_or_resume(folder.path, CONFIG.model_copy(update={"seed": 4}), lamps_yaml)
    assert contents(folder.path) == before


def test_what_holds_something_else_is_left_alone(tmp_path: Path, lamps_yaml: Path) -> None:
    """A user's own ``domain.yaml`` too."""
    path = tmp_path / "run"
    path.mkdir()
    (path / "domain.yaml").write_text("mine")
    with pytest.raises(RunFolderError, match="holds no run"):
        RunFolder.create_or_resume(path, CONFIG, lamps_yaml)
    assert contents(path) == {"domain.yaml": b"mine"}


def test_a_file_is_no_folder(tmp_path: Path, lamps_yaml: Path) -> None:
    (tmp_path / "run").write_text("mine")
    with pytest.raises(RunFolderError, match="got a file"):
        RunFolder.create_or_resume(tmp_path / "run", CONFIG, lamps_yaml)
    assert (tmp_path / "run").read_text() == "mine"


def test_a_crash_while_it_is_made_leaves_what_can_be_resumed(
    tmp_path: Path, lamps_yaml: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At every file, before it is in place."""

    def crash(self: Path, target: Path) -> None:
        raise CrashError

    path = tmp_path / "run"
    original = Path.replace
    for name in ("config.yaml", "domain.yaml"):
        monkeypatch.setattr(
            Path,
            "replace",
            lambda self, target, name=name: (
                crash(self, target) if target.name == name else original(self, target)
            ),
        )
        with pytest.raises(CrashError):
            RunFolder.create_or_resume(path, CONFIG, lamps_yaml)
    monkeypatch.undo()
    folder = RunFolder.create_or_resume(path, CONFIG, lamps_yaml)
    assert folder.config() == CONFIG
    assert (path / "domain.yaml").read_text() == DOMAIN_YAML


def test_opening(folder: RunFolder, tmp_path: Path) -> None:
    assert RunFolder.open(folder.path) == folder
    with pytest.raises(RunFolderError, match=r"expected the folder of a run"):
        RunFolder.open(tmp_path)


def test_damaged_settings_are_named_with_their_line(folder: RunFolder) -> None:
    path = folder.path / "config.yaml"
    path.write_text("run:\n  domain: lamps\n  sead: 3\n")
    with pytest.raises(ConfigurationError, match=r"config.yaml:3: unknown key 'sead'"):
        folder.config()
    path.write_text("- nothing\n")
    with pytest.raises(ConfigurationError):
        folder.config()


def test_finished_iterations_are_counted_without_gaps(folder: RunFolder) -> None:
    assert folder.finished_iterations() == 0
    for number in (1, 2, 4):
        write_json(folder.iteration(number) / "summary.json", {})
    (folder.iteration(3)).mkdir()
    assert folder.finished_iterations() == 2


def test_observations_survive(folder: RunFolder) -> None:
    several = Observation((Picture(b"one", "front"), Picture(b"two", "top")))
    for observation in (seen("left"), several):
        record = folder.save_observation(observation)
        json.dumps(record)
        assert folder.load_observation(record) == observation


def test_a_picture_is_kept_once(folder: RunFolder) -> None:
    for _ in range(2):
        folder.save_observation(seen("left"))
    assert len(list((folder.path / "images").iterdir())) == 1


def test_a_changed_picture_is_noticed(folder: RunFolder) -> None:
    record = folder.save_observation(seen("left"))
    (path,) = (folder.path / "images").iterdir()
    path.write_bytes(b"retouched")
    with pytest.raises(RunFolderError, match="changed since"):
        folder.load_observation(record)
    path.unlink()
    with pytest.raises(RunFolderError, match="missing"):
        folder.load_observation(record)

"""The folder of a run: made once, resumed with the same settings, never anything else's."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml
from lamps import lamp_domain, seen

from skillwrapper.errors import ConfigurationError, FileError, RunFolderError
from skillwrapper.files.writing import write_json
from skillwrapper.runs.archive import RunArchive, make_archive
from skillwrapper.runs.archive.records import FORMAT
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world import Domain, Observation, Picture, load_domain

SETTINGS = RunSettings(domain="lamps", seed=3)


class CrashError(Exception):
    pass


@pytest.fixture
def domain(tmp_path: Path) -> Domain:
    return lamp_domain(tmp_path)


@pytest.fixture
def archive(tmp_path: Path, domain: Domain) -> RunArchive:
    return make_archive(tmp_path / "run", SETTINGS, domain)


def contents(path: Path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in path.rglob("*") if p.is_file()}


def test_a_new_folder_holds_what_was_asked_for(archive: RunArchive, domain: Domain) -> None:
    assert archive.settings() == SETTINGS
    assert archive.domain() == domain
    assert set(contents(archive.path)) == {"config.yaml", "domain.yaml"}
    text = archive.config_text()
    assert text.startswith(f"format: {FORMAT}\n")
    assert all(word in text for word in ("made_with", "commit", "python", "numpy"))


def test_an_empty_folder_may_be_used(tmp_path: Path, domain: Domain) -> None:
    (tmp_path / "run").mkdir()
    assert make_archive(tmp_path / "run", SETTINGS, domain).settings() == SETTINGS


def test_what_a_kill_left_of_the_first_file_goes(tmp_path: Path, domain: Domain) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / ".config.yaml.1.tmp").write_text("for")
    made = make_archive(tmp_path / "run", SETTINGS, domain)
    assert set(contents(made.path)) == {"config.yaml", "domain.yaml"}


def test_the_same_settings_resume(archive: RunArchive, domain: Domain) -> None:
    before = contents(archive.path)
    more = SETTINGS.model_copy(update={"iterations": 50})
    assert make_archive(archive.path, more, domain) == archive
    assert contents(archive.path) == before


def test_other_settings_are_refused(archive: RunArchive, domain: Domain) -> None:
    before = contents(archive.path)
    with pytest.raises(RunFolderError, match=r"other settings \(seed: 3 there, 4 now\)"):
        make_archive(archive.path, SETTINGS.model_copy(update={"seed": 4}), domain)
    assert contents(archive.path) == before


def test_a_domain_that_has_changed_is_refused(archive: RunArchive, tmp_path: Path) -> None:
    path = tmp_path / "lamps.yaml"
    path.write_text(path.read_text().replace("Two lamps.", "Two bright lamps."))
    with pytest.raises(RunFolderError, match="'lamps' is not what it was when the run started"):
        make_archive(archive.path, SETTINGS, load_domain(path))


@pytest.mark.parametrize("text", [None, "", "name: [", "name: lamps\n"])
def test_a_domain_that_was_lost_is_written_again(
    archive: RunArchive, domain: Domain, text: str | None
) -> None:
    path = archive.layout.domain
    path.unlink() if text is None else path.write_text(text)
    make_archive(archive.path, SETTINGS, domain)
    assert archive.domain() == domain


def test_what_holds_something_else_is_left_alone(tmp_path: Path, domain: Domain) -> None:
    """A user's own ``domain.yaml`` too."""
    path = tmp_path / "run"
    path.mkdir()
    (path / "domain.yaml").write_text("mine")
    with pytest.raises(RunFolderError, match="holds no run"):
        make_archive(path, SETTINGS, domain)
    assert contents(path) == {"domain.yaml": b"mine"}


def test_a_file_is_no_folder(tmp_path: Path, domain: Domain) -> None:
    (tmp_path / "run").write_text("mine")
    with pytest.raises(RunFolderError, match="got a file"):
        make_archive(tmp_path / "run", SETTINGS, domain)
    assert (tmp_path / "run").read_text() == "mine"


def test_a_crash_while_it_is_made_leaves_what_can_be_resumed(
    tmp_path: Path, domain: Domain, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At every file, before it is in place; what nobody could clean up is no obstacle either."""

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
            make_archive(path, SETTINGS, domain)
        (path / ".config.yaml.4711.tmp").write_text("for")
    monkeypatch.undo()
    archive = make_archive(path, SETTINGS, domain)
    assert archive.settings() == SETTINGS
    assert archive.domain() == domain
    make_archive(path, SETTINGS, domain)
    assert set(contents(path)) == {"config.yaml", "domain.yaml"}


def test_opening(archive: RunArchive, tmp_path: Path) -> None:
    assert RunArchive.open(archive.path) == archive
    with pytest.raises(RunFolderError, match=r"expected the folder of a run"):
        RunArchive.open(tmp_path)


def test_damaged_settings_are_named_with_their_line(archive: RunArchive) -> None:
    path = archive.layout.config
    path.write_text(f"format: {FORMAT}\nrun:\n  domain: lamps\n  sead: 3\n")
    with pytest.raises(ConfigurationError, match=r"config.yaml:4: unknown key 'sead'"):
        archive.settings()
    path.write_text(f"format: {FORMAT}\n")
    with pytest.raises(ConfigurationError, match=r"config.yaml:1: .*expected keys and values"):
        archive.settings()


@pytest.mark.parametrize(
    ("found", "message"),
    [
        (FORMAT + 1, r"the run has format 2, and this version .* reads format 1; .*\(9\.9\)"),
        (None, r"config.yaml:1: expected 'format: 1', got None; .*older version"),
        ("one", r"config.yaml:1: expected 'format: 1', got 'one'"),
        (0, r"config.yaml:1: expected 'format: 1', got 0"),
    ],
)
def test_a_run_of_another_format_is_refused(
    archive: RunArchive, domain: Domain, found: object, message: str
) -> None:
    """Also if a newer version knows settings that this one does not."""
    content = {"format": found, "run": {"new": 1}, "made_with": {"skillwrapper": "9.9"}}
    archive.layout.config.write_text(yaml.safe_dump(content, sort_keys=False))
    before = contents(archive.path)
    with pytest.raises(RunFolderError, match=message):
        RunArchive.open(archive.path)
    with pytest.raises(RunFolderError, match=message):
        make_archive(archive.path, SETTINGS, domain)
    assert contents(archive.path) == before


def test_finished_iterations_are_those_up_to_the_last_summary(archive: RunArchive) -> None:
    """A gap is damage, and told when the iteration is read."""
    layout = archive.layout
    assert layout.finished_iterations() == 0
    with pytest.raises(RunFolderError, match="no iteration is finished"):
        archive.latest()
    write_json(layout.summary(2), {})
    layout.iteration(3).mkdir()
    assert layout.finished_iterations() == 2
    first, second = archive.iterations()
    with pytest.raises(FileError, match=r"001/summary\.json: cannot be read"):
        first.summary  # noqa: B018
    with pytest.raises(FileError, match=r"002/summary\.json:1: expected a value for"):
        second.summary  # noqa: B018


def test_observations_survive(archive: RunArchive) -> None:
    several = Observation((Picture(b"one", "front"), Picture(b"two", "top")))
    for observation in (seen("left"), several):
        records = archive.pictures.save(observation)
        json.dumps([record.model_dump() for record in records])
        assert archive.pictures.load(records) == observation


def test_a_picture_is_kept_once(archive: RunArchive) -> None:
    for _ in range(2):
        archive.pictures.save(seen("left"))
    assert len(list(archive.layout.images.iterdir())) == 1


def test_a_changed_picture_is_noticed(archive: RunArchive) -> None:
    records = archive.pictures.save(seen("left"))
    (path,) = archive.layout.images.iterdir()
    path.write_bytes(b"retouched")
    with pytest.raises(FileError, match="changed since"):
        archive.pictures.load(records)
    assert archive.pictures.find(records[0].sha256) is None
    path.unlink()
    with pytest.raises(FileError, match="missing"):
        archive.pictures.load(records)

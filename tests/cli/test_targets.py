"""Commands that are to write to a folder as a file, or the other way round, say so."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.errors import UserError
from skillwrapper.runs.launch import learn

_MOVES = '{"skill": "Cut", "arguments": ["robot", "lettuce"], "success": true, "before": [], "after": ["cut(lettuce)"]}\n'  # noqa: E501


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run, a file and a folder, as targets."""
    path = tmp_path_factory.mktemp("targets")
    learn({"domain": "burger", "iterations": 1, "exploration.budget": 6}, path / "run")
    (path / "file").write_text("mine")
    (path / "folder").mkdir()
    (path / "moves.jsonl").write_text(_MOVES)
    (path / "tiny.yaml").write_text("name: tiny\nmethods: [random]\ndomains: [burger]\n")
    return path


def names(place: Path) -> list[Path]:
    """All files, without those that SQLite keeps beside a database while it is read."""
    return sorted(p for p in place.rglob("*") if ".sqlite-" not in p.name)


@pytest.mark.parametrize(
    "command",
    [
        "learn burger --out file",
        "learn burger --out file/inside",
        "learn burger --out folder/../..",
        "report run --out folder",
        "report run --out file/page.html",
        "render burger --out folder",
        "render burger --out file/picture.png",
        "problems burger --easy 1 --hard 0 --impossible 0 --out folder",
        "learn-operators moves.jsonl --domain burger --out file",
        "experiment run tiny.yaml --out file",
        "calls folder",
        "show file",
        "verify folder",
        "plan nowhere --init file --goal x",
    ],
)
def test_a_wrong_target_is_refused_and_left_alone(
    place: Path, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(place)
    before = names(place)
    with pytest.raises(UserError) as raised:
        CliRunner().invoke(app, command.split(), catch_exceptions=False)
    assert "\n" not in str(raised.value)
    assert names(place) == before
    assert (place / "file").read_text() == "mine"

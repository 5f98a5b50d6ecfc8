"""``learn --predicates``: words that are known beforehand are used before a model is asked."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import command

from skillwrapper.domains.starting import start_project
from skillwrapper.runs.archive import RunArchive
from skillwrapper.vlm.protocol import Role

SHORT = ("--iterations", "2", "--budget", "8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project, and a run in it."""
    folder = tmp_path_factory.mktemp("known")
    start_project(folder / "cubes")
    assert command("learn", folder / "cubes", "--out", folder / "run", *SHORT) == 0
    return folder


def asked_for_words(run: Path) -> int:
    with RunArchive.open(run).open_calls() as store:
        assert store is not None
        return sum(call.role is Role.INVENT for call in store.calls())


def test_the_words_of_another_run_spare_asking(folder: Path) -> None:
    words, run = folder / "run" / "model" / "predicates.yaml", folder / "again"
    assert command("learn", folder / "cubes", "--predicates", words, "--out", run, *SHORT) == 0
    known, again = (RunArchive.open(folder / name).latest().model for name in ("run", "again"))
    assert set(again.predicates) <= set(known.predicates)
    assert asked_for_words(run) < asked_for_words(folder / "run")
    assert len(RunArchive.open(run).settings().predicates) == len(known.predicates)
    assert command("learn", folder / "cubes", "--predicates", words, "--out", run, *SHORT) == 0


def test_a_type_that_is_not_there(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = folder / "words.yaml"
    words.write_text("predicates:\n- name: red\n  types: [cobe]\n  semantics: it is red\n")
    out = folder / "none"
    assert command("learn", folder / "cubes", "--predicates", words, "--out", out) == 2
    assert "words.yaml:2: unknown type 'cobe'" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("['on(?cobe)']", "unknown type 'cobe'"),
        ("['on(']", "expected an atom like"),
        ("['a(?cube): x', 'a(?cube): y']", "'a' is defined twice"),
    ],
)
def test_settings_that_are_no_predicates(
    setting: str, said: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = folder / "none"
    words = ("--set", f"predicates={setting}")
    assert command("learn", folder / "cubes", *words, "--out", out, *SHORT) == 2
    assert said in capsys.readouterr().err
    assert not out.exists()

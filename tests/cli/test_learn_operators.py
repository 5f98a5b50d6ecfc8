"""``skillwrapper learn-operators``: the documented example, and mistakes in files."""

from __future__ import annotations

import json
import re
import runpy
import sys
from pathlib import Path

import pytest
from lamps import DOMAIN_YAML

from skillwrapper.cli.main import main
from skillwrapper.symbols.files import read_model, read_predicates
from skillwrapper.world import load_domain

PAGE = (Path(__file__).parents[2] / "docs" / "operators.md").read_text(encoding="utf-8")
LINES, PYTHON = re.search(r"```json\n(.*?)```.*```python\n(.*?)```", PAGE, re.DOTALL).groups()

GIVEN = ("moves.jsonl", "--domain", "domain.yaml")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """With the documented transitions in it; the working directory."""
    (tmp_path / "domain.yaml").write_text(DOMAIN_YAML, encoding="utf-8")
    (tmp_path / "moves.jsonl").write_text(LINES, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def command(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    monkeypatch.setattr(sys, "argv", ["skillwrapper", "learn-operators", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    return int(ended.value.code or 0)


def test_the_documented_example(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = (*GIVEN, "--out", "lamps")
    assert command(monkeypatch, *words) == 0
    said = capsys.readouterr().out
    assert "Light_1: Light(?hand: hand, ?lamp: lamp)" in said
    assert "5 transitions, 5 decided, violations: 0 of Lemma 1, 0 of Theorem 1" in said
    model = read_model(folder / "lamps" / "model.json", load_domain(folder / "domain.yaml"))
    assert [o.name for o in model.operators] == ["Light_1", "PutOut_1"]
    assert "(:action light_1" in (folder / "lamps" / "domain.pddl").read_text(encoding="utf-8")
    vocabulary = read_predicates(folder / "lamps" / "predicates.yaml", model.domain)
    assert vocabulary == model.predicates
    assert command(monkeypatch, *words, "--json", "--predicates", "lamps/predicates.yaml") == 0
    told = json.loads(capsys.readouterr().out)
    assert command(monkeypatch, *words, "--json", "--set", "learning.least_confidence=0.99") == 0
    assert json.loads(capsys.readouterr().out)["certificate"]["decided"] == 4
    assert command(monkeypatch, *words) == 0
    assert told["operators"] == ["Light_1", "PutOut_1"]
    written = json.loads((folder / "lamps" / "certificate.json").read_text(encoding="utf-8"))
    assert told["certificate"] == written
    assert written["violations"] == []
    assert written["untested"]["Light_1"] == ["not lit(?lamp)"]


def test_the_documented_python(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script = folder / "example.py"
    script.write_text(PYTHON, encoding="utf-8")
    left = runpy.run_path(str(script))
    assert capsys.readouterr().out == "['Light_1', 'PutOut_1'] ()\n"
    assert len(left["more"]) == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("moves.jsonl", "--domain", "domain.yaml", "--set", "learning.learner=x"),
            "unknown learner",
        ),
        (("moves.jsonl", "--domain", "nowhere/domain.yaml"), "nowhere"),
        (("bad.jsonl", "--domain", "domain.yaml"), "bad.jsonl:2: unknown skill 'Lite'; did you"),
        (("absent.jsonl", "--domain", "domain.yaml"), "absent.jsonl: cannot be read"),
    ],
)
def test_mistakes_are_one_sentence(
    words: tuple[str, ...],
    said: str,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    first = LINES.splitlines()[0]
    bad = f"{first}\n{first.replace('Light', 'Lite')}\n"
    (folder / "bad.jsonl").write_text(bad, encoding="utf-8")
    assert command(monkeypatch, *words, "--out", "out") == 2
    captured = capsys.readouterr()
    assert captured.err.startswith("error: ")
    assert said in captured.err
    assert captured.err.count("\n") == 1
    assert not (folder / "out").exists()

"""The tutorial says what happens: its commands are taken from the page, and run."""

from __future__ import annotations

import re
import shlex
import time
from pathlib import Path

import pytest
from command_line import command

PAGE = Path(__file__).parents[2] / "docs" / "tutorial.md"

CHARACTERS_A_MINUTE = 100
"""Of somebody who types slowly, and reads on the way."""


def words_of(page: str) -> str:
    return " ".join(page.split())


def test_tutorial_leads_from_nothing_to_an_executed_plan(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In order, in an empty folder; what the page shows of the output is in the output."""
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text("utf-8")
    said = typed = ""
    started = time.process_time()
    for kind, block in re.findall(r"```(\w+)\n(.*?)```", page, re.DOTALL):
        if kind == "text":
            for line in filter(None, map(str.strip, block.splitlines())):
                assert line == "..." or words_of(line) in words_of(said)
        for line in block.splitlines() if kind == "sh" else ():
            typed += line
            program, *words = shlex.split(line)
            assert program == "skillwrapper"
            assert command(*words) == 0, line
            captured = capsys.readouterr()
            said = captured.out + captured.err
    assert len(typed) < CHARACTERS_A_MINUTE * 5
    assert time.process_time() - started < 120
    assert "Four predicates were invented" in page
    assert len(list((tmp_path / "run" / "executions").iterdir())) == 1

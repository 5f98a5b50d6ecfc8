"""A person as the model."""

from __future__ import annotations

import io
import re
import sys
from pathlib import Path

import pytest
from command_line import command
from PIL import Image

from skillwrapper.errors import LimitReachedError
from skillwrapper.runs.launch import learn
from skillwrapper.vlm.human_model import HumanModel
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.world.observation import Picture

DOMAIN = """
name: lamps
agent: A hand.
description: Two lamps; the light one shines.
types: {hand: {}, lamp: {}}
objects: {hand: {types: [hand]}, left: {types: [lamp]}, right: {types: [lamp]}}
skills:
  Light: {parameters: [{name: hand, type: hand}, {name: lamp, type: lamp}]}
  PutOut: {parameters: [{name: hand, type: hand}, {name: lamp, type: lamp}]}
robot: robot.py:Hand
"""
ROBOT = """
import numpy as np
import skillwrapper


class Hand(skillwrapper.Robot):
    replayable = True

    def prepare(self, seed):
        self.lit = set()

    def look(self):
        picture = np.zeros((8, 16, 3), np.uint8)
        for number, lamp in enumerate(("left", "right")):
            picture[:, number * 8 : number * 8 + 8] = 255 if lamp in self.lit else 40
        return picture

    def run(self, skill, *arguments):
        works = (arguments[1] in self.lit) != (skill == "Light")
        self.lit ^= {arguments[1]} if works else set()
        return works
"""
PROMPT = """# Task

## Pictures
- Picture 1: now

## Predicates
- lit(?lamp): the lamp shines
- near(?lamp, ?lamp): they touch

## Statements
- lit(left)
- lit(right)
- near(left, right)

## Answer
Freely.
"""


class Person:
    """Opens the pictures that it is told of, and types."""

    def __init__(self, patience: int = 10**6) -> None:
        self.questions: list[str] = []
        self.patience = patience
        self.picture = ""

    def __call__(self, question: str) -> str:
        if len(self.questions) == self.patience:
            raise EOFError
        self.questions.append(question)
        if found := re.search(r"open (\S+)", question):
            self.picture = found[1]
        if asked := re.search(r"lit\((left|right)\)\?", question):
            column = 2 if asked[1] == "left" else 12
            return "y" if Image.open(self.picture).getpixel((column, 4))[0] > 128 else "n"
        return "lit(?lamp): the lamp shines" if "invent a predicate" in question else ""


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    (tmp_path / "lamps").mkdir()
    (tmp_path / "lamps" / "domain.yaml").write_text(DOMAIN)
    (tmp_path / "lamps" / "robot.py").write_text(ROBOT)
    return tmp_path / "lamps"


def typing(*lines: str) -> HumanModel:
    remaining = iter(lines)

    def ask(question: str) -> str:
        try:
            return next(remaining)
        except StopIteration:
            raise EOFError from None

    return HumanModel(ask)


def request(role: Role = Role.EVALUATE, prompt: str = PROMPT) -> ModelRequest:
    png = io.BytesIO()
    Image.new("RGB", (16, 8)).save(png, "PNG")
    return ModelRequest(role, "", prompt, (Picture(png.getvalue()),))


@pytest.mark.parametrize(
    ("typed", "verdicts"),
    [
        (("y", "n", "?"), "true false unsure"),
        (("yn?",), "true false unsure"),
        (("y", "b", "N", " ", "maybe", "yyyyy", "y y"), "false true true"),
    ],
)
def test_statements_are_judged_one_by_one(typed: tuple[str, ...], verdicts: str) -> None:
    said = typing(*typed).complete(request()).text
    assert [line.split(": ")[1] for line in said.splitlines()] == verdicts.split()
    assert said.startswith("lit(left): ")


def test_a_summary_of_what_a_person_said_is_what_they_said() -> None:
    prompt = '# Task: summarise\n## Text\n"""\nlit(left): true\n"""'
    assert typing().complete(request(Role.SUMMARISE, prompt)).text == "lit(left): true"


def test_whoever_leaves_is_told_that_it_goes_on(lamps: Path) -> None:
    for typed in ((), ("y", "q")):
        with pytest.raises(LimitReachedError, match="the same command goes on later"):
            typing(*typed).complete(request())


def test_a_person_teaches_what_lamps_do_and_may_leave_in_between(lamps: Path) -> None:
    settings = {"domain": str(lamps), "iterations": 2, "exploration.budget": 6}
    whole = Person()
    learned = learn(settings, lamps / "whole", model=HumanModel(whole))
    assert [p.signature for p in learned.model.predicates] == ["lit(?lamp)"]
    assert learned.figures.inconsistencies == 0

    first, second = Person(patience=7), Person()
    with pytest.raises(LimitReachedError):
        learn(settings, lamps / "parts", model=HumanModel(first))
    learn(settings, lamps / "parts", model=HumanModel(second))
    kept, again = (lamps / run / "model" / "model.json" for run in ("whole", "parts"))
    assert again.read_bytes() == kept.read_bytes()
    in_flight = 2  # a picture whose statements were not all answered is asked about again
    assert len(first.questions) + len(second.questions) <= len(whole.questions) + in_flight


def test_pictures_that_were_shown_are_taken_away(lamps: Path) -> None:
    person = Person()
    model = HumanModel(person)
    model.complete(request(prompt=PROMPT.replace("- near(left, right)\n", "")))
    assert Path(person.picture).is_file()
    model.close()
    assert not Path(person.picture).exists()


def test_in_the_terminal(
    lamps: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("lit(?lamp): the lamp shines\n\ny\n"))
    words = ("learn", lamps, "--out", lamps / "run", "--model", "human", "--iterations", "1")
    assert command(*words) == 3
    told = capsys.readouterr().err
    assert "invent a predicate" in told
    assert re.search(r"Picture 1 \(.*\): open \S+picture_1.png", told)
    assert re.search(r"2/2 lit\(\w+\)\? \[y, n, \?", told)
    assert "the same command goes on later" in told

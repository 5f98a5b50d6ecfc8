"""Carrying out a plan while somebody moves things, skills hang, and the robot is stopped."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.starting import start_project
from skillwrapper.planning.hypotheses.doubtful_planner import WantedReading
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.runs.careful_execution import CarefulExecution
from skillwrapper.runs.carrying_out import Ending, ExecutionReport, ExecutionSettings
from skillwrapper.runs.doubtful_execution import DoubtfulExecution
from skillwrapper.runs.execution_records import ExecutionRecord
from skillwrapper.runs.launch import learn, learn_recorded
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import Look
from skillwrapper.world.robot import RobotEnvironment
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance, parse_skill_instance

GOAL = ("Open(arm, box)", "Pick(arm, green_cube)", "PutIn(arm, green_cube, box)", "Close(arm, box)")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model of the starting project, learned to the end: it takes seconds, and is worth them."""
    folder = tmp_path_factory.mktemp("careful")
    start_project(folder / "cubes")
    learn({"domain": str(folder / "cubes"), "iterations": 4}, folder / "run")
    return folder / "run"


class Meddling(RobotEnvironment):
    """The fake robot, at which somebody does something just before a look.

    Args:
        run: of the model; its domain's robot is used.
        at: before which look, from 1.
        meddle: what is done to the fake arm.
    """

    def __init__(
        self, run: Path, at: int = 0, meddle: Callable[[object], None] | None = None
    ) -> None:
        made = find_domain(RunArchive(run).settings().domain).make_environment()
        assert isinstance(made, RobotEnvironment)
        super().__init__(made._robot, made.domain)
        self.take_up(self.present())
        self._looks, self._at, self._meddle = 0, at, meddle

    @property
    def arm(self):  # type: ignore[no-untyped-def]
        return self._robot.arm  # type: ignore[attr-defined]

    def observe(self) -> Observation:
        self._looks += 1
        if self._looks == self._at and self._meddle is not None:
            self._meddle(self.arm)
        return super().observe()


def carry_out(
    run: Path, out: Path, environment: RobotEnvironment, **settings: float
) -> ExecutionReport:
    with LearnedModel.load(run) as learned:
        wanted = find_domain(learned.settings.domain).make_environment()
        wanted.reset(seed=0)
        for text in GOAL:
            assert wanted.execute(parse_skill_instance(text)).success
        goal = learned.goal(wanted.observe())
        record = ExecutionRecord(RunLayout(out))
        chosen = ExecutionSettings.model_validate({"plan_limit": 20, **settings})
        return CarefulExecution(learned, environment, goal, record, chosen).run()


def lid(arm) -> None:  # type: ignore[no-untyped-def]
    arm.is_open = not arm.is_open


def take_from_hand(arm) -> None:  # type: ignore[no-untyped-def]
    arm.held = None


def put_red_in(arm) -> None:  # type: ignore[no-untyped-def]
    arm.inside = arm.inside | {"red_cube"}


def events_of(out: Path) -> list[dict[str, object]]:
    return [
        json.loads(line) for line in (out / "executions" / "001.jsonl").read_text().splitlines()
    ]


def test_an_undisturbed_plan_is_carried_out_without_surprise(run: Path, tmp_path: Path) -> None:
    report = carry_out(run, tmp_path, Meddling(run))
    assert (report.ending, report.plans, report.surprises) == (Ending.REACHED, 1, [])
    assert all(success for _, success in report.executed)


@pytest.mark.parametrize("meddle", [lid, take_from_hand])
def test_what_somebody_moves_is_noticed_and_planned_around(
    meddle: Callable[[object], None], run: Path, tmp_path: Path
) -> None:
    # The looks are: the first one, and one before each skill and (by run) after it.
    environment = Meddling(run, at=4, meddle=meddle)
    report = carry_out(run, tmp_path, environment)
    assert report.ending is Ending.REACHED
    assert report.plans > 1
    assert [s.kind for s in report.surprises] == ["moved"] or report.surprises[0].kind == "effect"
    assert [e["event"] for e in events_of(tmp_path)].count("surprise") == len(report.surprises)
    assert "green_cube" in environment.arm.inside
    assert not environment.arm.is_open


def test_what_cannot_be_mended_ends_without_a_plan(run: Path, tmp_path: Path) -> None:
    report = carry_out(run, tmp_path, Meddling(run, at=4, meddle=put_red_in))
    assert report.ending is Ending.NO_PLAN
    assert report.surprises


def test_without_replanning_a_surprise_ends_it(run: Path, tmp_path: Path) -> None:
    report = carry_out(run, tmp_path, Meddling(run, at=4, meddle=lid), replans=0)
    assert report.ending is Ending.NOT_REACHED
    assert len(report.surprises) == 1


class Failing(Meddling):
    """A skill that fails without any reason in sight, for ever."""

    def execute(self, instance: SkillInstance) -> Outcome:
        if instance.skill == "Pick":
            return Outcome(False, self.observe(), "the motor is tired")
        return super().execute(instance)


def test_what_failed_is_not_tried_again_in_the_same_state(run: Path, tmp_path: Path) -> None:
    report = carry_out(run, tmp_path, Failing(run))
    assert report.ending is Ending.NO_PLAN
    picks = [i for i, _ in report.executed if i.skill == "Pick"]
    assert 1 <= len(picks) <= 2  # with the lid open, and closed
    assert any(s.kind == "failed" for s in report.surprises)


class Hanging(Meddling):
    def execute(self, instance: SkillInstance) -> Outcome:
        threading.Event().wait(5)
        return super().execute(instance)


class Broken(Meddling):
    def execute(self, instance: SkillInstance) -> Outcome:
        raise ZeroDivisionError("wheels")


class Stopped(Meddling):
    """Somebody presses the button while a skill runs."""

    pressed = False

    def halted(self) -> str | None:
        return "the red button" if self.pressed else None

    def execute(self, instance: SkillInstance) -> Outcome:
        self.pressed = True
        return super().execute(instance)


@pytest.mark.parametrize(
    ("kind", "ending", "said"),
    [
        (Hanging, Ending.BROKEN, "expected an end within 0.2 s"),
        (Broken, Ending.BROKEN, "ZeroDivisionError: wheels"),
        (Stopped, Ending.STOPPED, "emergency stop: the red button"),
    ],
)
def test_whatever_happens_it_ends_and_is_recorded(
    kind: type[Meddling], ending: Ending, said: str, run: Path, tmp_path: Path
) -> None:
    report = carry_out(run, tmp_path, kind(run), skill_limit=0.2)
    assert report.ending is ending
    assert said in report.reason
    *_, began, ended = events_of(tmp_path)
    assert began["event"] == "started"
    assert report.reason.startswith(began["skill"])
    assert ended == {"event": "ended", "ending": ending, "reason": report.reason}


def carry_out_in_doubt(
    run: Path, out: Path, environment: RobotEnvironment, misread: int = 0
) -> ExecutionReport:
    """As ``carry_out``, under doubt; the picture of a look, from 1, is read wrongly."""
    with Misled.load(run) as learned:
        wanted = find_domain(learned.settings.domain).make_environment()
        wanted.reset(seed=0)
        for text in GOAL:
            assert wanted.execute(parse_skill_instance(text)).success
        goal = WantedReading(learned.read(wanted.observe()).labels)
        known = learned.doubts().known(environment.scene)
        assert known is not None
        learned.misread = misread
        record, chosen = ExecutionRecord(RunLayout(out)), ExecutionSettings(replans=3)
        return DoubtfulExecution(learned, known, environment, goal, record, chosen).run()


class Misled(LearnedModel):
    """Takes what the hand holds, in one picture, for nothing."""

    misread = 0
    looks = 0

    def read(self, seen: Look, *, scene: Scene | str | None = None) -> AbstractState:
        state = super().read(seen, scene=scene)
        if not self.misread:
            return state
        self.looks += 1
        if self.looks != self.misread:
            return state
        labels = np.where([len(a.terms) > 1 for a in state.space.atoms], 0, state.labels)
        return replace(state, labels=labels.astype(np.int8))


@pytest.mark.parametrize("misread", [0, 3])
def test_what_is_misread_on_the_way_is_overruled(run: Path, tmp_path: Path, misread: int) -> None:
    report = carry_out_in_doubt(run, tmp_path, Meddling(run), misread)
    assert report.ending is Ending.REACHED
    assert report.plans == 1
    assert report.surprises == []


def test_what_somebody_does_is_noticed_under_doubt(run: Path, tmp_path: Path) -> None:
    report = carry_out_in_doubt(run, tmp_path, Meddling(run, 2, put_red_in))
    assert report.ending in (Ending.REACHED, Ending.NO_PLAN, Ending.NOT_REACHED)
    assert events_of(tmp_path)[-1]["event"] == "ended"


def test_an_execution_is_an_episode_of_the_next_learn(run: Path, tmp_path: Path) -> None:
    before = RunArchive(run).layout.recorded_episodes()
    report = carry_out(run, run, Meddling(run, at=4, meddle=lid))
    assert RunArchive(run).layout.recorded_episodes() == before + 1
    found = RunArchive(run).episode(before + 1)
    assert found is not None
    assert found.given
    assert [t.instance for t in found.transitions] == [i for i, _ in report.executed]
    assert any(a.after.key != b.before.key for a, b in pairwise(found.transitions))
    result = learn_recorded(run)
    assert len(result.episodes) == before + 1

"""Whole runs of Algorithm 1: what is learned, what is written, what a crash does."""

from __future__ import annotations

import csv
import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from lamps import LampAssistant, LampEnvironment, lamp_domain

from skillwrapper.errors import ModelUnavailableError, RobotError, UnknownNameError
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm
from skillwrapper.runs.archive import ArchiveWriter, RunArchive, make_archive
from skillwrapper.runs.events import (
    EpisodeStarted,
    IterationFinished,
    IterationStarted,
    PredicateDecided,
    RunEvent,
    RunFinished,
    SequenceChosen,
    SkillExecuted,
)
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import Atom
from skillwrapper.symbols.files import read_model
from skillwrapper.world import Observation, Scene

CONFIG = RunSettings(
    domain="lamps",
    iterations=3,
    exploration=ExplorationSettings(explorer="paper", budget=8, least_length=8, candidates=3),
)


class Setting:
    """A run in a folder of its own."""

    def __init__(self, path: Path, config: RunSettings = CONFIG) -> None:
        self.path = path
        self.config = config
        self.events: list[RunEvent] = []

    def run(
        self,
        environment: LampEnvironment | None = None,
        assistant: LampAssistant | None = None,
        **changes: object,
    ) -> LearningResult:
        settings = self.config.model_copy(update=changes)
        self.path.mkdir(exist_ok=True)
        domain = lamp_domain(self.path)
        self.archive = make_archive(self.path / "run", settings, domain)
        layout = self.archive.layout
        return LearningAlgorithm(
            settings,
            environment or LampEnvironment(domain),
            assistant or LampAssistant(),
            [ArchiveWriter(self.archive), self.events.append],
            EarlierRun(self.archive.episode, layout.finished_iterations()),
        ).run()

    def files(self, *parts: str) -> dict[str, bytes]:
        """What a run leaves that tells nothing of when it happened."""
        root = self.archive.path
        return {
            str(p.relative_to(root)): p.read_bytes()
            for part in parts
            for p in sorted((root / part).rglob("*"))
            if p.is_file()
        }


LASTING = ("model", "episodes", "iterations", "images")


@pytest.fixture
def whole(tmp_path: Path) -> Setting:
    setting = Setting(tmp_path / "whole")
    setting.run()
    return setting


def test_from_nothing_to_a_model_that_accounts_for_all(tmp_path: Path) -> None:
    result = Setting(tmp_path).run()
    assert result.executions == 24
    assert result.iterations == 3
    assert {"lit"} <= {p.name for p in result.fit.predicates}
    assert result.fit.inconsistencies == ()
    assert result.unresolved == ()
    assert result.certificate.violations == ()
    figures = result.figures.model_dump()
    assert figures["inconsistencies_by_kind"] == {
        "precondition": 0,
        "effect": 0,
        "determinism": 0,
        "unexplained": 0,
    }
    assert figures["operators"] == len(result.fit.operators) >= 2


def test_every_iteration_is_described(whole: Setting) -> None:
    root = whole.archive.path
    for number in (1, 2, 3):
        target = whole.archive.layout.iteration(number)
        assert {p.name for p in target.iterdir()} == {
            "certificate.json",
            "decisions.json",
            "model.json",
            "operators.txt",
            "predicates.yaml",
            "summary.json",
            "truth_table.csv",
            "unresolved.json",
        }
        summary = json.loads((target / "summary.json").read_text())
        assert summary["executions"] == 8 * number
        assert 0 < summary["pairs_covered"] <= 1
    assert {p.name for p in (root / "model").iterdir()} == {
        "domain.pddl",
        "model.json",
        "predicates.yaml",
    }
    assert json.loads((root / "result.json").read_text())["iterations"] == 3
    latest = RunArchive.open(root).latest()
    assert latest.summary.executions == 24
    assert latest.model == read_model(root / "model" / "model.json", latest.domain)


def test_decisions_say_why(whole: Setting) -> None:
    decisions = json.loads((whole.archive.layout.iteration(1) / "decisions.json").read_text())
    verdicts = {(d["verdict"], d["predicate"]) for d in decisions}
    assert ("rejected", "round(?lamp)") in verdicts
    assert ("accepted", "lit(?lamp)") in verdicts
    for decision in decisions:
        assert decision["reason"]
        for witness in (decision["inconsistency"] or {}).get("witnesses", []):
            for sha256 in (*witness["before"], *witness["after"]):
                assert (whole.archive.path / "images" / f"{sha256}.png").exists()


def test_calls_that_were_needed_are_counted_beside_those_of_asking_everything_again(
    whole: Setting,
) -> None:
    """Three executions leave at most four pictures; every candidate would have all asked again."""
    summary = json.loads((whole.archive.layout.iteration(3) / "summary.json").read_text())
    result = json.loads((whole.archive.path / "result.json").read_text())
    for name in ("evaluation_calls", "evaluation_calls_reasking"):
        assert summary[name] == result[name] > 0
    decisions = json.loads((whole.archive.layout.iteration(1) / "decisions.json").read_text())
    first = json.loads((whole.archive.layout.iteration(1) / "summary.json").read_text())
    candidates = {d["predicate"] for d in decisions if d["verdict"] in {"accepted", "rejected"}}
    header, *rows = (whole.archive.layout.iteration(1) / "truth_table.csv").read_text().splitlines()
    assert header
    assert first["evaluation_calls_reasking"] == len(candidates) * len(rows)


def test_agreement_of_votes_is_kept_for_every_predicate(tmp_path: Path) -> None:
    class Torn(LampAssistant):
        """Three votes, of which one says otherwise about ``lit``."""

        def evaluate(self, questions):
            return [
                replace(answer, agreement={a: 2 / 3 if a.terms else 1.0 for a in answer.labels})
                for answer in super().evaluate(questions)
            ]

    setting = Setting(tmp_path)
    setting.run(assistant=Torn())
    learned = setting.archive.latest()
    assert {p.name: learned.agreement(p) for p in learned.model.predicates} == {
        p.name: 0.6667 if p.types else 1.0 for p in learned.model.predicates
    }


def test_the_truth_table_has_a_row_a_picture(whole: Setting) -> None:
    target = whole.archive.layout.iteration(3)
    text = (target / "truth_table.csv").read_text()
    header, *rows = csv.reader(text.splitlines())
    assert header[0] == "observation"
    assert "lit(left)" in header
    assert len(rows) == len({row[0] for row in rows})
    for row in rows:
        picture = (whole.archive.path / "images" / f"{row[0]}.png").read_text()
        assert row[header.index("lit(left)")] == str(int("lit(left)" in picture))


def test_unknown_labels_are_marked_and_counted(tmp_path: Path) -> None:
    class Unsure(LampAssistant):
        """Cannot tell whether the right lamp shines once the left one does."""

        def evaluate(self, questions):
            answers = super().evaluate(questions)
            for question, answer in zip(questions, answers, strict=True):
                right = Atom("lit", ("right",))
                if b"lit(left)" in question.observation.pictures[0].png and right in answer.labels:
                    answer.labels[right] = None
            return answers

    setting = Setting(tmp_path)
    result = setting.run(assistant=Unsure())
    certificate = result.certificate
    assert certificate.undecided > 0
    assert certificate.decided + certificate.undecided == certificate.transitions == 24
    assert ",?" in (setting.archive.layout.iteration(3) / "truth_table.csv").read_text()


def test_same_settings_same_run(whole: Setting, tmp_path: Path) -> None:
    """D14"""
    again = Setting(tmp_path / "again")
    again.run()
    assert again.files(*LASTING) == whole.files(*LASTING)


def test_another_seed_another_run(whole: Setting, tmp_path: Path) -> None:
    other = Setting(tmp_path / "other", CONFIG.model_copy(update={"seed": 1}))
    other.run()
    assert other.files("episodes") != whole.files("episodes")


@pytest.mark.parametrize("skills", [0, 5, 8, 13, 23])
def test_a_run_that_broke_down_ends_in_the_same_model(
    whole: Setting, tmp_path: Path, skills: int
) -> None:
    broken = Setting(tmp_path / "broken")
    with pytest.raises(RobotError):
        broken.run(LampEnvironment(lamp_domain(tmp_path), stops_after=skills))
    assert broken.run().figures.model_dump() == json.loads(
        (whole.archive.path / "result.json").read_text()
    )
    assert broken.files(*LASTING) == whole.files(*LASTING)


def test_a_model_that_does_not_answer_stops_the_run_and_loses_nothing(
    whole: Setting, tmp_path: Path
) -> None:
    class Silent(LampAssistant):
        def __init__(self) -> None:
            self.left = 3

        def evaluate(self, questions):
            if self.left == 0:
                raise ModelUnavailableError("no answer")
            self.left -= 1
            return super().evaluate(questions)

    broken = Setting(tmp_path / "broken")
    with pytest.raises(ModelUnavailableError):
        broken.run(assistant=Silent())
    broken.run()
    assert broken.files(*LASTING) == whole.files(*LASTING)


def test_a_finished_run_executes_nothing_more(whole: Setting) -> None:
    before = whole.files(*LASTING)
    events = whole.archive.layout.events.read_bytes()
    whole.run(LampEnvironment(lamp_domain(whole.path), stops_after=0))
    assert whole.files(*LASTING) == before
    assert whole.archive.layout.events.read_bytes() == events


def test_more_iterations_go_on_where_it_ended(whole: Setting, tmp_path: Path) -> None:
    environment = LampEnvironment(lamp_domain(whole.path))
    result = whole.run(environment, iterations=4)
    assert len(environment.executed) == 8
    assert environment.resets == [4]
    straight = Setting(tmp_path / "straight")
    assert straight.run(iterations=4).figures == result.figures
    assert straight.files(*LASTING) == whole.files(*LASTING)


def test_every_iteration_starts_with_a_reset_of_its_own(tmp_path: Path) -> None:
    """D16"""
    environment = LampEnvironment(lamp_domain(tmp_path))
    Setting(tmp_path, CONFIG.model_copy(update={"seed": 2})).run(environment)
    assert environment.resets == [2001, 2002, 2003]


def test_whoever_watches_is_told(whole: Setting) -> None:
    kinds = [type(e) for e in whole.events]
    assert kinds[:3] == [IterationStarted, SequenceChosen, EpisodeStarted]
    assert kinds[-2:] == [IterationFinished, RunFinished]
    assert kinds.count(SequenceChosen) == kinds.count(EpisodeStarted) == 3
    assert kinds.count(SkillExecuted) == 24
    assert PredicateDecided in kinds
    lines = whole.archive.events()
    assert [line.event for line in lines].count("skill_executed") == 24
    chosen = next(line for line in lines if line.event == "sequence_chosen")
    assert set(chosen.model_extra or {}) == {"sequence", "scores", "pareto", "notes"}


def test_no_folder_is_needed(whole: Setting, tmp_path: Path) -> None:
    """The result holds everything that the folder does."""
    environment = LampEnvironment(lamp_domain(tmp_path))
    result = LearningAlgorithm(CONFIG, environment, LampAssistant()).run()
    archive = whole.archive
    assert sorted(path.name for path in tmp_path.iterdir() if path.is_dir()) == ["whole"]
    assert result.model == archive.latest().model
    assert result.episodes == archive.episodes()
    assert result.figures.model_dump() == json.loads(archive.layout.result.read_text())
    kept = [[(d.verdict, d.reason) for d in i.decisions] for i in archive.iterations()]
    assert [[(d.verdict, d.reason) for d in made] for made in result.decisions] == kept


@pytest.mark.parametrize("lost", ["model", "iterations", "iterations/002", "result.json"])
def test_what_was_lost_is_computed_again(whole: Setting, lost: str) -> None:
    before = whole.files(*LASTING)
    path = whole.archive.path / lost
    shutil.rmtree(path) if path.is_dir() else path.unlink()
    whole.run(LampEnvironment(lamp_domain(whole.path), stops_after=0))
    assert whole.files(*LASTING) == before


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe"])
def test_what_was_damaged_is_written_again(whole: Setting, content: bytes) -> None:
    """Every file but those that cannot be computed again: episodes, pictures, calls."""
    before = whole.files(*LASTING)
    root = whole.archive.path
    for path in (*root.glob("iterations/*/*"), *root.glob("model/*"), root / "domain.yaml"):
        path.write_bytes(content)
    whole.run(LampEnvironment(lamp_domain(whole.path), stops_after=0))
    assert whole.files(*LASTING) == before


def test_scenes_take_turns(tmp_path: Path) -> None:
    """All of the domain, or those that the settings name."""
    plain = lamp_domain(tmp_path)
    bench = [Scene.of(name, plain.object_by_name, plain.objects) for name in ("day", "night")]
    domain = replace(plain, declared_scenes=tuple(bench))
    for asked, expected in (((), ["day", "night", "day"]), (("night",), ["night"] * 3)):
        settings = CONFIG.model_copy(update={"scenes": asked})
        environment = TwoScenes(domain)
        result = LearningAlgorithm(settings, environment, LampAssistant()).run()
        assert [episode.scene.name for episode in result.episodes] == expected
    with pytest.raises(UnknownNameError, match="unknown scene 'dawn'"):
        LearningAlgorithm(
            CONFIG.model_copy(update={"scenes": ("dawn",)}),
            TwoScenes(domain),
            LampAssistant(),
        )


class TwoScenes(LampEnvironment):
    """Lamps that are in the scene that was asked for last."""

    _scene = ""

    @property
    def scene(self) -> Scene:
        return self.domain.scene(self._scene)

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        self._scene = self.domain.scene(scene).name
        return super().reset(seed=seed, scene=scene)

"""Whole runs that learn from decoded labels: what is kept, and that they can be resumed."""

from __future__ import annotations

from pathlib import Path

import pytest
from lamps import LampAssistant, LampEnvironment, lamp_domain

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.perception.settings import PerceptionSettings
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm
from skillwrapper.runs.archive import ArchiveWriter, RunArchive, make_archive
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings

FAITHFUL = RunSettings(
    domain="lamps",
    iterations=3,
    exploration=ExplorationSettings(explorer="paper", budget=8, least_length=8, candidates=3),
)
ROBUST = FAITHFUL.model_copy(update={"learning": LearningSettings(learner="robust")})


def _run(folder: Path, settings: RunSettings, earlier: EarlierRun | None = None) -> LearningResult:
    folder.mkdir(exist_ok=True)
    domain = lamp_domain(folder)
    archive = make_archive(folder / "run", settings, domain)
    environment, observers = LampEnvironment(domain), [ArchiveWriter(archive)]
    return LearningAlgorithm(settings, environment, LampAssistant(), observers, earlier).run()


def test_what_decoding_made_of_the_readings_is_kept(tmp_path: Path) -> None:
    result = _run(tmp_path, ROBUST)
    kept = RunArchive.open(tmp_path / "run").latest().decoding
    assert kept is not None
    assert result.decoding is not None
    assert kept.readings == result.decoding.readings > 0
    assert [r.predicate for r in kept.rates] == [p.name for p in result.fit.predicates]
    assert kept.overruled == ()


def test_without_errors_both_learners_say_the_same(tmp_path: Path) -> None:
    robust, faithful = _run(tmp_path / "a", ROBUST), _run(tmp_path / "b", FAITHFUL)
    assert robust.fit.inconsistencies == faithful.fit.inconsistencies == ()
    assert [str(o.operator) for o in robust.fit.operators] == [
        str(o.operator) for o in faithful.fit.operators
    ]
    assert faithful.decoding is None
    assert RunArchive.open(tmp_path / "b" / "run").latest().decoding is None


@pytest.mark.parametrize(
    ("labels", "learner", "decodes"),
    [
        ("auto", "faithful", False),
        ("auto", "robust", True),
        ("raw", "robust", False),
        ("decoded", "faithful", True),
    ],
)
def test_labels_suit_the_learner_unless_they_are_chosen(
    labels: str, learner: str, decodes: bool
) -> None:
    settings = FAITHFUL.model_copy(
        update={
            "learning": LearningSettings(learner=learner),
            "perception": PerceptionSettings.model_validate({"labels": labels}),
        }
    )
    assert settings.decodes_labels is decodes


def test_a_resumed_run_says_the_same(tmp_path: Path) -> None:
    first = _run(tmp_path, ROBUST)
    archive = RunArchive.open(tmp_path / "run")
    earlier = EarlierRun(archive.episode, archive.layout.finished_iterations())
    again = _run(tmp_path, ROBUST, earlier)
    assert again.figures == first.figures
    assert again.decoding == first.decoding

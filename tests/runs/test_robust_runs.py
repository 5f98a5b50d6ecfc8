"""Whole runs that learn from decoded labels: what is kept, and that they can be resumed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from lamps import LampAssistant, LampEnvironment, lamp_domain

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.perception.settings import PerceptionSettings
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm
from skillwrapper.runs.archive import ArchiveWriter, RunArchive, make_archive
from skillwrapper.runs.archive.pictures import PictureStore
from skillwrapper.runs.events import RunEvent, StartSeen
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


@pytest.mark.parametrize(
    ("learner", "restores", "seen"),
    [("robust", True, 6), ("robust", False, 0), ("faithful", True, 0)],
)
def test_starts_are_looked_at_beforehand_where_they_tell_of_misreading(
    tmp_path: Path, learner: str, restores: bool, seen: int
) -> None:
    """Only where labels are in doubt, and a reset is known to bring the same state back."""
    domain = replace(lamp_domain(tmp_path), resets_restore_state=restores)
    settings = ROBUST.model_copy(
        update={"iterations": 1, "learning": LearningSettings(learner=learner)}
    )
    archive = make_archive(tmp_path / "run", settings, domain)
    events: list[RunEvent] = []
    observers = [ArchiveWriter(archive), events.append]
    LearningAlgorithm(settings, LampEnvironment(domain), LampAssistant(), observers).run()
    starts = [event for event in events if isinstance(event, StartSeen)]
    assert len({event.seed for event in starts}) == len(starts) == seen
    kept = PictureStore(archive.layout.images)
    for event in starts:
        assert kept.path(event.start.pictures[0].sha256).exists()

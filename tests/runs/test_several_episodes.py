"""An iteration of several episodes: where one ends early, its budget is used after a reset."""

from __future__ import annotations

from pathlib import Path

import pytest
from lamps import LampAssistant, LampEnvironment, lamp_domain

from skillwrapper.errors import RobotError
from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.report.history import RunHistory
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm
from skillwrapper.runs.archive import ArchiveWriter, RunArchive, make_archive
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world.episode import Episode

BUDGET, STUCK = 8, 3
CONFIG = RunSettings.model_validate({
    "domain": "lamps", "iterations": 2, "exploration": {"budget": BUDGET},
})  # fmt: skip


class Impatient:
    """Is stuck after some skills."""

    def __init__(self, resumes: bool) -> None:
        self._resumes = resumes

    def next_skill(self, situation: Situation) -> NextSkill:
        if len(situation.done) == STUCK:
            return NextSkill(None, "stuck", resumes=self._resumes)
        instances = situation.fit.domain.skill_instances
        return NextSkill(instances[len(situation.done) % len(instances)])

    def record(self, episode: Episode) -> None:
        """Nothing is remembered."""


def run(
    path: Path, environment: LampEnvironment | None = None, config: RunSettings = CONFIG
) -> LearningResult:
    path.mkdir(exist_ok=True)
    domain = lamp_domain(path)
    archive = make_archive(path / "run", config, domain)
    return LearningAlgorithm(
        config,
        environment or LampEnvironment(domain),
        LampAssistant(),
        [ArchiveWriter(archive)],
        EarlierRun(archive.episode, archive.layout.finished_iterations()),
    ).run()


@pytest.fixture
def stuck(monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, resumes=True)


def use(monkeypatch: pytest.MonkeyPatch, *, resumes: bool) -> None:
    made = "skillwrapper.runs.algorithm.make_explorer"
    monkeypatch.setattr(made, lambda *given: Impatient(resumes))


@pytest.mark.usefixtures("stuck")
def test_what_is_left_is_used_in_further_episodes(tmp_path: Path) -> None:
    environment = LampEnvironment(lamp_domain(tmp_path))
    result = run(tmp_path, environment)
    assert [len(e.transitions) for e in result.episodes] == [3, 3, 2, 3, 3, 2]
    assert environment.resets == [1, 2, 3, 4, 5, 6]
    assert (result.figures.iterations, result.figures.episodes) == (2, 6)
    archive = RunArchive.open(tmp_path / "run")
    assert archive.episodes() == result.episodes
    assert [i.executions for i in RunHistory.read(archive).iterations] == [BUDGET, BUDGET]


@pytest.mark.usefixtures("stuck")
@pytest.mark.parametrize(
    ("price", "lengths"),
    [(1, [3, 3, 3, 3]), (2, [3, 3, 3, 3]), (4, [3, 1, 3, 1]), (BUDGET, [3, 3])],
)
def test_a_reset_costs_as_much_of_the_budget_as_is_set(
    tmp_path: Path, price: int, lengths: list[int]
) -> None:
    dear = CONFIG.exploration.model_copy(update={"reset_price": price})
    result = run(tmp_path, config=CONFIG.model_copy(update={"exploration": dear}))
    assert [len(e.transitions) for e in result.episodes] == lengths


def test_only_an_explorer_that_wants_it_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    use(monkeypatch, resumes=False)
    assert [len(e.transitions) for e in run(tmp_path).episodes] == [STUCK, STUCK]


@pytest.mark.usefixtures("stuck")
@pytest.mark.parametrize("after", range(0, 2 * BUDGET, 3))
def test_a_run_that_was_stopped_goes_on_in_the_same_episode(tmp_path: Path, after: int) -> None:
    whole = run(tmp_path / "whole")
    broken = LampEnvironment(lamp_domain(tmp_path), stops_after=after)
    with pytest.raises(RobotError):
        run(tmp_path / "broken", broken)
    assert run(tmp_path / "broken").figures == whole.figures
    files = [
        {p.name: p.read_bytes() for p in (tmp_path / name / "run" / "episodes").iterdir()}
        for name in ("whole", "broken")
    ]
    assert files[0] == files[1]

"""The report of an experiment: tables, curves, and every unsolved case with its pictures."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from outside_links import parse
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.evaluation.benchmark.cells import RESULT, CellResult
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment, ProblemChoice
from skillwrapper.evaluation.problems.causes import Cause
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.files.writing import write_json
from skillwrapper.report import render_experiment
from skillwrapper.report.experiment_contents import ExperimentContents

MODEL = {"precision": 1.0, "effect_accuracy": 1.0, "predicates": 4, "operators": 6}
CURVE = [{"executions": 30 * n, "recall": 0.3 * n, **MODEL} for n in (1, 2, 3)]


def result(problem: Problem, *, solved: bool) -> ProblemResult:
    return ProblemResult(
        problem=problem.name,
        kind=problem.kind,
        solved=solved,
        claimed_impossible=problem.kind is ProblemClass.IMPOSSIBLE and solved,
        budget=None if problem.length is None else 1 if solved else 10,
        length=problem.length if solved else None,
        optimal=problem.length,
        executions=3,
        planning_seconds=0.1,
        seconds=0.2,
        calls=0,
        cause=None if solved else Cause.SKILL_FAILED,
        detail="" if solved else "Pick(robot, <b>patty</b>) is predicted to work, and fails",
        plan=("Pick(robot, patty)",),
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> ExperimentFolder:
    """Two methods with two seeds; ``ours`` never solves the hard problem."""
    experiment = Experiment(
        name="pretended",
        methods=("ours", "vila"),
        seeds=(0, 1),
        problems=ProblemChoice(easy=2, hard=1, impossible=1),
    )
    folder = ExperimentFolder.create_or_resume(tmp_path_factory.mktemp("x") / "out", experiment)
    folder.note_run("skillwrapper experiment run pretended.yaml")
    for cell in experiment.cells:
        ours = cell.method == "ours"
        problems = folder.problems("burger").problems
        results = tuple(result(p, solved=not ours or p.name != "hard-01") for p in problems)
        efficiency = {"area": 0.2, "changing": 0.1, "pairs_covered": 0.1, "curve": CURVE}
        found = CellResult(cell, results, None, {}, efficiency if ours else None, 1.0)
        write_json(folder.cell(cell) / RESULT, found.to_json())
    return folder


def test_the_same_thing_with_several_seeds_is_one_case(folder: ExperimentFolder) -> None:
    contents = ExperimentContents.gather(folder)
    (problem,) = contents.problems
    assert (problem.problem.name, problem.solved, problem.tried) == ("hard-01", 2, 4)
    (case,) = problem.cases
    assert (case.method, case.seeds, case.cause) == ("SkillWrapper (ours)", (0, 1), "skill failed")
    (group,) = contents.groups
    assert [row.shares for row in group.matrix] == [(1, 1, 1, 1), (1, 1, 0, 1)]
    assert [chart.title for chart in group.charts] == ["Exact recall", "Exact precision"]
    assert group.charts[0].series[0].points[-1] == (90, pytest.approx(0.9))


def test_the_page_needs_nothing_from_outside(folder: ExperimentFolder) -> None:
    page = render_experiment(folder)
    parsed = parse(page)
    assert parsed.found == []
    assert "script" not in parsed.tags
    assert parsed.targets <= parsed.ids
    assert parsed.tags["img"] == 2
    assert "<b>patty" not in page
    text = " ".join("".join(parsed.texts).split())
    assert "Made with the embedded model" in text
    assert "skillwrapper experiment run pretended.yaml" in text
    for title in ("Problems solved", "Beside the paper", "Why problems were not solved"):
        assert title in text
    assert render_experiment(folder) == page


def test_pictures_are_small_and_drawn_once(folder: ExperimentFolder) -> None:
    page = render_experiment(folder, picture_width=64)
    pictures = re.findall(r"data:image/webp;base64,[\w+/=]+", page)
    assert len(set(pictures)) == 2
    assert max(map(len, pictures)) < 6000


def test_command(folder: ExperimentFolder, tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    done = CliRunner().invoke(app, ["report", str(folder.path), "--out", str(out)])
    assert done.exit_code == 0, done.output
    assert out.read_text().startswith("<!DOCTYPE html>")

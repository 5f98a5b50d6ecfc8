"""Means, deviations, comparisons, and what becomes of them in tables and plots."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace
from pathlib import Path

import pytest
from made_up_cells import made_up_cell

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import MissingDependencyError
from skillwrapper.evaluation.benchmark import plots
from skillwrapper.evaluation.benchmark.comparisons import compare, mcnemar
from skillwrapper.evaluation.benchmark.experiments import CommandRecord, Experiment
from skillwrapper.evaluation.benchmark.figures import MethodFigures, Spread
from skillwrapper.evaluation.benchmark.summary import ExperimentSummary
from skillwrapper.evaluation.benchmark.table_formats import to_csv, to_latex, to_markdown
from skillwrapper.evaluation.exact.learning_curves import area_under
from skillwrapper.evaluation.published import published_figures
from skillwrapper.runs.settings import ModelSettings

ALL, NONE = (True,) * 4, (False,) * 4

CELLS = (
    made_up_cell("ours", 0, ALL, recall=1.0),
    made_up_cell("ours", 1, (True, False, True, True), recall=0.8),
    made_up_cell("vila", 0, (True, False, False, False), recall=None, learned=False),
    made_up_cell("vila", 1, NONE, recall=None, learned=False),
)
EXPERIMENT = Experiment(name="made_up", methods=("ours", "vila"), seeds=(0, 1, 2))


def figures(*cells: int) -> MethodFigures:
    return MethodFigures.of([CELLS[number] for number in cells])


def test_spread() -> None:
    assert Spread.of([1.0, None, 3.0]) == Spread(2.0, pytest.approx(2**0.5), 2)
    assert Spread.of([4.0]) == Spread(4.0, 0.0, 1)
    assert Spread.of([None, None]) is None


def test_figures_of_a_method() -> None:
    ours = figures(0, 1)
    assert ours.figures["easy"] == Spread(75.0, pytest.approx(35.355, abs=1e-3), 2)
    assert ours.figures["hard"] == Spread(100.0, 0.0, 2)
    assert ours.figures["budget_easy"] == Spread(3.25, pytest.approx(3.182, abs=1e-3), 2)
    assert ours.figures["falsely_impossible"] == Spread(0.0, 0.0, 2)
    assert ours.figures["length_ratio"] == Spread(2.0, 0.0, 2)
    assert ours.figures["recall"] == Spread(0.9, pytest.approx(0.1414, abs=1e-3), 2)
    assert ours.causes == {"operator missing": 1}


def test_what_a_method_has_not_is_not_zero() -> None:
    vila = figures(2, 3)
    for name in ("recall", "area", "learning_calls", "planning_easy"):
        assert vila.figures[name] is None
    # Both failed at the hard problem and said that it was impossible.
    assert vila.figures["falsely_impossible"] == Spread(pytest.approx(100 / 3), 0.0, 2)


def test_an_unknown_cost_is_neither_zero_nor_left_out() -> None:
    known = made_up_cell("ours", 0, ALL, cost=0.5)
    unknown = made_up_cell("ours", 1, ALL, cost=None)
    assert MethodFigures.of([known]).figures["cost"] == Spread(0.5, 0.0, 1)
    both = MethodFigures.of([known, unknown])
    assert both.figures["cost"] is None
    assert both.is_unknown("cost")
    assert both.is_unknown("learning_cost")
    assert not figures(2, 3).is_unknown("learning_cost")  # nothing was asked
    texts = {t.title: t.rows for t in ExperimentSummary.of(EXPERIMENT, [known, unknown]).tables()}
    assert "unknown" in texts["Solving all problems (burger, noise none)"][0]
    assert "unknown" in texts["Exploration and learning (burger, noise none)"][0]


def test_the_paper_stands_beside() -> None:
    table = next(t for t in report().tables() if t.title.startswith("Beside the paper"))
    assert table.rows[0][:5] == ("ViLa", "25.0 ± 35.4", "46.0 ± 16.2", "7.8 ± 3.2", "-")
    assert "real GPT-5" in to_markdown(report())


def test_how_it_was_made_is_told() -> None:
    made = {"skillwrapper": "1.0", "commit": "0123456789abcdef", "changed": True, "python": "3.11"}
    told = ExperimentSummary.of(
        EXPERIMENT, CELLS, (CommandRecord("skillwrapper experiment run x", made),)
    )
    text = to_markdown(told)
    assert "- Command: `skillwrapper experiment run x`" in text
    assert "commit 0123456789ab with uncommitted changes (Python 3.11)" in text
    assert "- Seeds: 0, 1, 2" in text
    assert "embedded model" in text
    assert "% Seeds: 0, 1, 2" in to_latex(told)


def test_comparison_is_paired_by_problem_and_seed() -> None:
    found = compare(CELLS[:2], CELLS[2:])
    assert (found.pairs, found.wins, found.losses) == (8, 6, 0)
    assert found.difference == Spread(75.0, 0.0, 2)
    assert found.p_value == mcnemar(6, 0) == 2 / 2**6
    back = compare(CELLS[2:], CELLS[:2])
    assert (back.wins, back.losses, back.p_value) == (0, 6, found.p_value)
    assert compare(CELLS[:1], CELLS[3:]).pairs == 0


@pytest.mark.parametrize(
    ("wins", "losses", "p_value"), [(0, 0, 1.0), (3, 3, 1.0), (5, 0, 0.0625), (1, 9, 0.021484375)]
)
def test_mcnemar(wins: int, losses: int, p_value: float) -> None:
    assert mcnemar(wins, losses) == p_value


@pytest.mark.parametrize(
    ("points", "area"),
    [
        ([], None),
        ([(5, None)], None),
        ([(10, 1.0)], 0.0),
        ([(10, 1.0), (20, 1.0)], 0.5),
        ([(5, 0.4), (10, 1.0)], 0.2),
    ],
)
def test_area_under_a_staircase(points: list[tuple[int, float | None]], area: float | None) -> None:
    assert area_under(points) == pytest.approx(area)


def report() -> ExperimentSummary:
    published = published_figures(find_domain("burger")).results
    return ExperimentSummary.of(EXPERIMENT, CELLS, published={"burger": published})


def test_report_as_json() -> None:
    data = json.loads(json.dumps(report().to_json()))
    by_name = {method["method"]: method for method in data["methods"]}
    wanted = {"method", "easy", "hard", "impossible", "budget_easy", "budget_hard", "causes"}
    assert wanted <= set(by_name["ours"])
    assert by_name["ours"]["hard"] == {"mean": 100.0, "std": 0.0}
    assert by_name["vila"]["recall"] is None
    assert "embedded model" in data["note"]
    assert (data["cells"], data["finished"]) == (6, 4)
    assert [c["other"] for c in data["comparisons"]] == ["vila"]


def test_tables_leave_out_methods_without_figures() -> None:
    by_title = {table.title: table for table in report().tables()}
    solved = by_title["Problems solved (burger, noise none)"]
    assert [row[0] for row in solved.rows] == ["ViLa", "SkillWrapper (ours)"]
    assert solved.rows[1][1:3] == ("75.0 ± 35.4", "3.2 ± 3.2")
    exact = by_title["The model, checked in every state (burger, noise none)"]
    assert [row[0] for row in exact.rows] == ["SkillWrapper (ours)"]


def test_markdown_and_latex_and_csv() -> None:
    markdown = to_markdown(report())
    assert "| SkillWrapper (ours) | 75.0 ± 35.4 | 3.2 ± 3.2 | 100.0 ± 0.0 |" in markdown
    assert "embedded model" in markdown
    latex = to_latex(report())
    assert r"SkillWrapper (ours) & 75.0 $\pm$ 35.4" in latex
    assert latex.count(r"\begin{tabular}") == latex.count(r"\end{tabular}") == 7
    assert r"easy \%" in latex
    rows = list(csv.DictReader(io.StringIO(to_csv(report()))))
    assert [row["method"] for row in rows] == ["vila", "ours"]
    assert float(rows[1]["easy_mean"]) == 75.0
    assert rows[0]["recall_mean"] == ""


def test_plots(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    noisy = tuple(made_up_cell("ours", seed, NONE, noise="0.1") for seed in (0, 1))
    clustered = (made_up_cell("ours", 0, ALL, noise="gpt5"),)
    written = plots.plot_experiment((*CELLS, *noisy, *clustered), tmp_path / "plots")
    assert [path.name for path in written] == [
        "learning-burger-none.png",
        "problems-burger-none.png",
        "learning-burger-0.1.png",
        "problems-burger-0.1.png",
        "learning-burger-gpt5.png",
        "problems-burger-gpt5.png",
        "noise-burger.png",
    ]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in written)


def test_plots_without_matplotlib(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> object:
        raise ImportError(name)

    monkeypatch.setattr(plots.importlib, "import_module", missing)
    with pytest.raises(MissingDependencyError, match=r"pip install 'skillwrapper\[plot\]'"):
        plots.plot_experiment(CELLS, tmp_path)


def test_undefined_is_neither_one_nor_left_out_silently() -> None:
    """Fault 25: a model that predicts nothing has no precision."""
    nothing = replace(CELLS[0], exact={**(CELLS[0].exact or {}), "precision": None})
    texts = {t.title: t.rows for t in ExperimentSummary.of(EXPERIMENT, [nothing]).tables()}
    row = texts["The model, checked in every state (burger, noise none)"][0]
    assert row[1] == "undefined"
    both = {t.title: t.rows for t in ExperimentSummary.of(EXPERIMENT, [nothing, CELLS[1]]).tables()}
    row = both["The model, checked in every state (burger, noise none)"][0]
    assert row[1].endswith("(1 of 2 seeds)")
    assert ExperimentSummary.of(EXPERIMENT, [nothing]).to_json()["methods"][0]["precision"] is None


def test_no_p_value_where_a_constant_of_the_stand_in_decides() -> None:
    """D25: how well the stand-in guesses actions is a number of ours."""
    found = report()
    assert [c.p_value for c in found.comparisons] == [None]
    table = next(t for t in found.tables() if t.title.startswith("Same problems"))
    assert table.rows[0][-1] == "-"
    assert "No p-value where the proposals of the stand-in model decide" in table.note
    real = EXPERIMENT.settings.model_copy(update={"model": ModelSettings(name="openai:x")})
    asked = EXPERIMENT.model_copy(update={"settings": real})
    assert ExperimentSummary.of(asked, CELLS).comparisons[0].p_value == mcnemar(6, 0)


def test_every_table_says_who_carries_what() -> None:
    for table in report().tables():
        assert "Who carries what: " in table.note
    note = report().tables()[0].note
    assert "ViLa: the model names every action; the package executes them." in note

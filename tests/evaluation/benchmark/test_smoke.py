"""The shipped experiment ``smoke.yaml``, with less to learn: every method from start to end."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from skillwrapper.cli import experiments
from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.benchmark import running
from skillwrapper.evaluation.methods.learned import unchanged
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.methods.skillwrapper import (
    OURS_OFTEN_RESET,
    OURS_ONCE_A_SCENE,
    OURS_PAPER_BUDGET,
)

SMOKE = Path(__file__).parents[3] / "experiments" / "smoke.yaml"
PREPARED = BurgerState(cut=True, cooked=True)
"""A quarter of all states can be reached from here."""
COUNTS = {"easy": 3, "hard": 2, "impossible": 2}


@pytest.mark.slow
def test_smoke(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(BurgerEnvironment, "start", lambda kitchen: PREPARED)
    # Its own size, that of the paper, is checked in ``methods/test_configurations.py``.
    as_small = replace(OURS_PAPER_BUDGET, configure=unchanged)
    monkeypatch.setattr(running, "METHODS", {**METHODS, as_small.name: as_small})
    app = typer.Typer()
    experiments.register(app)
    out = tmp_path / "smoke"
    line = ["experiment", "run", str(SMOKE), "--out", str(out), "--json"]
    less = ["--set", "iterations=2", "--set", "exploration.budget=8"]
    done = CliRunner().invoke(app, [*line, *less], catch_exceptions=False)

    assert done.exit_code == 0, done.output
    report = json.loads(done.stdout)
    assert report["failed"] == {}
    left_out = {OURS_ONCE_A_SCENE.name, OURS_OFTEN_RESET.name}
    assert report["finished"] == report["cells"] == len(METHODS) - len(left_out)
    rows = {row["method"]: row for row in report["methods"]}
    assert list(rows) == [name for name in METHODS if name not in left_out]
    for name in ("expert", "expert-read"):
        exact = {key: rows[name][key]["mean"] for key in ("easy", "hard", "impossible")}
        assert exact == {"easy": 100, "hard": 100, "impossible": 100}
        assert rows[name]["budget_easy"]["mean"] == rows[name]["budget_hard"]["mean"] == 1
        assert rows[name]["recall"]["mean"] == rows[name]["precision"]["mean"] == 1
        assert rows[name]["causes"] == {}
    for name, row in rows.items():
        unsolved = sum(row["causes"].values())
        solved = sum(row[kind]["mean"] * count / 100 for kind, count in COUNTS.items())
        assert round(solved) + unsolved == sum(COUNTS.values()), name
    for name in ("ours", "ours-5x15", "random", "fm-invent", "no-heuristic", "paper-exploration"):
        assert 0 < rows[name]["area"]["mean"] < 1
        assert (out / "cells" / f"{name}-burger-s0-none" / "run" / "curve.json").is_file()

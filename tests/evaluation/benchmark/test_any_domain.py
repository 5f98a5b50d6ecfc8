"""Experiments run on whatever can be reset and executed; exact figures appear where states are."""

from __future__ import annotations

import json
from typing import Any

import pytest
from lamp_shop import PARTS, write_lamp_shop
from typer.testing import CliRunner

from skillwrapper.cli.main import app

FILE = """\
name: lamps
methods: [ours, random, vila, expert, system]
domains: [{domain}]
settings:
  iterations: 3
  exploration: {{budget: 8}}
  planner: {{time_limit: 5}}
"""
PROBLEMS = """\
domain: shop
problems:
- {name: test, class: easy, scene: shelf, seed: 3, goal_test: all_lit, goal_literals: LITERALS}
- {name: states, class: easy, length: 1, scene: window, layout: 4, initial: {state: []},
   goal: {state: [green]}}
- {name: words, class: easy, scene: window, seed: 5, goal_literals: "is_purple(green)"}
"""


@pytest.fixture(scope="module", params=["Shop", "Bare"])
def done(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A finished experiment on a domain in a folder, that can do much or little."""
    place = tmp_path_factory.mktemp("experiment")
    parts = PARTS if request.param == "Shop" else PARTS.splitlines(keepends=True)[0]
    domain = write_lamp_shop(
        place / "shop", robot=request.param, parts=parts + "problems: p.yaml\n"
    )
    if request.param == "Bare":
        (domain / "p.yaml").write_text(
            "domain: shop\nproblems:\n- {name: words, class: easy, scene: shelf, seed: 1, "
            "goal_literals: 'is_lit(red)'}\n"
        )
    else:
        (domain / "p.yaml").write_text(PROBLEMS.replace("LITERALS", "'lit(red), lit(blue)'"))
    file = place / "lamps.yaml"
    file.write_text(FILE.format(domain="./shop"))
    command = ["experiment", "run", str(file), "--out", str(place / "out"), "--json"]
    found = CliRunner().invoke(app, command, catch_exceptions=False)
    return request.param, place / "out", json.loads(found.stdout), found.exit_code


def rows(data: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {row["method"]: row for row in data["methods"]}


def test_learning_methods_run_anywhere(done: Any) -> None:
    robot, _, data, _ = done
    found = rows(data)
    assert {"ours", "random", "vila"} <= set(found)
    assert found["random"]["learning_executions"]["mean"] == 24
    for name in ("ours", "random"):
        # A planned episode ends where nothing within reach is worth a try.
        assert 16 < found[name]["learning_executions"]["mean"] <= 24
        if robot == "Shop":
            assert found[name]["recall"]["mean"] == found[name]["vocabulary"]["mean"] == 1.0
        else:
            assert found[name]["recall"] is found[name]["area"] is None


def test_what_a_baseline_lacks_is_one_sentence(done: Any) -> None:
    robot, _, data, exit_code = done
    assert exit_code == 1
    failed = {name.partition("-")[0]: text for name, text in data["failed"].items()}
    assert (
        "expected a key 'expert' for comparing with an expert's model, got none"
        in (failed["expert"])
    )
    assert ("system" in failed) is (robot == "Bare")
    if robot == "Bare":
        assert "expected a key 'system_predicates'" in failed["system"]
    assert all("\n" not in text for text in failed.values())


def test_problems_of_every_kind(done: Any) -> None:
    robot, out, _, _ = done
    (cell,) = (p for p in (out / "cells").iterdir() if p.name.startswith("ours-"))
    lines = (cell / "problems.jsonl").read_text().splitlines()
    results = {line["problem"]: line for line in map(json.loads, lines)}
    if robot == "Bare":
        assert results["words"]["judge"] == "model"  # reached as far as the model can tell
        return
    assert (results["states"]["solved"], results["states"]["judge"]) == (True, "environment")
    assert results["words"]["cause"] == "goal not expressible"
    assert "is_purple" in results["words"]["detail"]


def test_report_and_tables(done: Any) -> None:
    _, out, _, _ = done
    shown = CliRunner().invoke(app, ["experiment", "table", str(out)], catch_exceptions=False)
    assert shown.exit_code == 0
    assert "Who carries what" in shown.stdout
    made = CliRunner().invoke(app, ["report", str(out)], catch_exceptions=False)
    assert made.exit_code == 0, made.output

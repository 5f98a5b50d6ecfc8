"""Learning curves: from the models of a run to a file that its report shows."""

from __future__ import annotations

import io
import json
from functools import cached_property
from pathlib import Path

import pytest
from rich.console import Console

from skillwrapper.cli.verification import print_curve
from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.learning_curves import (
    Stage,
    area_under,
    learning_curve,
    read_stages,
)
from skillwrapper.evaluation.exact.run_checks import CheckOptions, LabelSource, check_run
from skillwrapper.evaluation.exact.state_readers import AtomReader
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.report import render_report
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel


class FirstStates(BurgerEnvironment):
    """A kitchen of which only the start and what follows at once is looked at."""

    @cached_property
    def first(self) -> tuple[BurgerState, ...]:
        return super().reachable_states()[:5]

    def reachable_states(self, start: BurgerState | None = None) -> tuple[BurgerState, ...]:
        return self.first

    def successor(self, state: BurgerState, instance: object) -> tuple[bool, BurgerState]:
        succeeded, after = super().successor(state, instance)  # type: ignore[arg-type]
        return (succeeded, after) if after in self.first else (False, state)


def test_the_expert_knows_all_and_nobody_knows_nothing() -> None:
    model = expert_model()
    states = LabelledStates(SceneStates(BurgerEnvironment()), AtomReader(expert_atoms))
    empty = AbstractModel(model.domain, model.predicates, ())
    stages = (Stage(10, empty), Stage(30, model))
    first, last = learning_curve(stages, [states])
    assert (first.executions, first.precision, first.recall) == (10, None, 0.0)
    assert (last.precision, last.recall, last.effect_accuracy) == (1.0, 1.0, 1.0)
    assert last.operators == len(model.operators)
    assert area_under([(p.executions, p.recall) for p in (first, last)]) == 0.0


def test_the_curve_of_a_run_is_kept_and_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = RunSettings(domain="burger", iterations=2, exploration=ExplorationSettings(budget=5))
    learn(config, tmp_path / "run")
    archive = RunArchive.open(tmp_path / "run")
    assert "Exact truth" not in render_report(archive)
    monkeypatch.setattr(DomainPackage, "make_environment", lambda package: FirstStates())
    output = Console(file=io.StringIO(), width=120)

    plain = check_run(archive, CheckOptions())
    checked = check_run(archive, CheckOptions(LabelSource.MODEL, curve=True))

    assert (plain.curve, plain.labels) == ((), LabelSource.TRUE)
    assert "curve" not in plain.to_json()
    assert [p.executions for p in checked.curve] == [5, 10]
    assert len(read_stages(archive)) == 2
    assert checked.curve[-1].recall == checked.verification.recall
    written = json.loads(archive.layout.curve.read_text())
    assert written == checked.to_json()["curve"]
    assert "Exact truth" in render_report(archive)
    print_curve(checked.curve, output)
    assert "area under recall" in output.file.getvalue()  # type: ignore[attr-defined]

"""Methods prepared in a cell: what they learn, from which data, and how they go on later."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.system_predicates import SYSTEM_PREDICATES
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import InternalError
from skillwrapper.evaluation.benchmark.call_costs import learning_costs
from skillwrapper.evaluation.benchmark.efficiency import efficiency_of
from skillwrapper.evaluation.exact.exact_states import ExactStates
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.method import CellContext, Prepared
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.evaluation.problems.problem_files import read_problems
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.archive import RunArchive

SETTINGS = ExperimentSettings(iterations=2, exploration=ExplorationSettings(budget=12))


@cache
def exact() -> ExactStates:
    return ExactStates.of(find_domain("burger"))


@contextmanager
def prepared(method: str, folder: Path, source: Path | None = None) -> Iterator[Prepared]:
    cell = Cell(method, "burger", 1, "none")
    context = CellContext(
        cell, SETTINGS, folder, source, BurgerEnvironment(), find_domain("burger"), exact()
    )
    with METHODS[method].prepare(context) as ready:
        yield ready


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a finished cell of the whole method."""
    folder = tmp_path_factory.mktemp("ours")
    with prepared("ours", folder):
        return folder


def test_learned_method_leaves_a_run(ours: Path) -> None:
    assert RunArchive.open(ours / "run").layout.finished_iterations() == 2
    with prepared("ours", ours) as again:  # resumed: nothing is executed a second time
        assert [stage.executions for stage in again.stages] == [12, 24]
        assert again.figures["executions"] == 24
        costs = learning_costs(again.run)
        assert costs is not None
        assert (costs.calls > 0, costs.cost) == (True, 0.0)
        assert again.recorded is not None


def test_system_learns_from_the_same_executions(ours: Path, tmp_path: Path) -> None:
    with prepared("ours", ours) as whole, prepared("system", tmp_path, ours) as system:
        assert system.episodes == whole.episodes
        assert [stage.executions for stage in system.stages] == [12, 24]
        model = system.stages[-1].model
        assert model.predicates == SYSTEM_PREDICATES
        assert model.operators
        assert not any(operator.absences for operator in model.operators)
        efficiency = efficiency_of(system, find_domain("burger").domain)
    assert efficiency is not None
    assert len(efficiency.curve) == 2
    assert 0 < efficiency.changing <= 1
    assert 0 < efficiency.pairs_covered < 0.1
    with prepared("system-absence", tmp_path, ours) as system:
        assert any(operator.absences for operator in system.stages[-1].model.operators)


def test_system_needs_a_source(tmp_path: Path) -> None:
    with (
        pytest.raises(InternalError, match="expected a source cell"),
        prepared("system", tmp_path),
    ):
        pytest.fail("prepared without data")


def test_batch_is_invented_once(tmp_path: Path) -> None:
    with prepared("fm-invent", tmp_path) as ready:
        assert len(ready.stages[0].model.predicates) > 0
    first, second = RunArchive.open(tmp_path / "run").iterations()
    assert sum(d.reason == "one of the batch" for d in first.decisions) > 3
    assert not any(d.reason == "one of the batch" for d in second.decisions)


@pytest.mark.parametrize("method", ["expert", "expert-read"])
def test_expert_solves_a_problem(method: str, tmp_path: Path) -> None:
    (problem,) = (
        read_problems(find_domain("burger").problems, BurgerEnvironment()).first(1, 0, 0).problems
    )
    with prepared(method, tmp_path) as ready:
        found = ready.solver.solve(problem)
        assert efficiency_of(ready, find_domain("burger").domain) is None
    assert found.solved
    assert found.budget == 1
    assert (found.calls > 0) is (method == "expert-read")

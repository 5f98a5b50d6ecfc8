"""Cells run once, in an order that works; failures and killed processes cost only themselves."""

from __future__ import annotations

import multiprocessing
import time
from pathlib import Path

import pytest
from crashing_task import crash_once, never_end, take_long

from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.benchmark import running
from skillwrapper.evaluation.benchmark.cells import RESULT, CellResult
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment, ProblemChoice
from skillwrapper.evaluation.benchmark.processes import Processes
from skillwrapper.evaluation.benchmark.running import (
    ERROR,
    OwnProcess,
    open_workers,
    run_experiment,
)
from skillwrapper.evaluation.benchmark.workers import CellOutcome
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.exploration.settings import ExplorationSettings


def make_folder(path: Path, *methods: str) -> ExperimentFolder:
    experiment = Experiment(
        name="x",
        methods=methods,
        seeds=(0, 1),
        settings=ExperimentSettings(iterations=1, exploration=ExplorationSettings(budget=4)),
        problems=ProblemChoice(easy=1, hard=0, impossible=1),
    )
    return ExperimentFolder.create_or_resume(path, experiment)


class PretendingWorkers:
    """Write an empty result for every cell; some cells fail."""

    def __init__(self, folder: ExperimentFolder, *failing: str) -> None:
        self.folder, self.failing = folder, failing
        self.taken: list[str] = []
        self._open: list[Cell] = []

    def submit(self, cell: Cell) -> None:
        self.taken.append(cell.name)
        self._open.append(cell)

    def next(self) -> CellOutcome:
        cell = self._open.pop(0)
        if cell.name in self.failing:
            return CellOutcome(cell, "broken")
        self.folder.cell(cell).mkdir(parents=True)
        (self.folder.cell(cell) / RESULT).touch()
        return CellOutcome(cell)


def test_sources_first_and_nothing_twice(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "out", "system", "ours", "expert")
    team = PretendingWorkers(folder)
    ended: list[str] = []
    run_experiment(folder, team, ended=lambda outcome: ended.append(outcome.cell.name))
    assert len(team.taken) == len(set(team.taken)) == 6
    for seed in (0, 1):
        ours, system = f"ours-burger-s{seed}-none", f"system-burger-s{seed}-none"
        assert team.taken.index(system) > ended.index(ours)
    again = PretendingWorkers(folder)
    assert run_experiment(folder, again) == ()
    assert again.taken == []


def test_failure_costs_only_what_depends_on_it(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "out", "system", "ours", "expert")
    team = PretendingWorkers(folder, "ours-burger-s0-none")
    errors = {o.cell.name: o.error for o in run_experiment(folder, team) if o.error}
    assert errors == {
        "ours-burger-s0-none": "broken",
        "system-burger-s0-none": "ours-burger-s0-none, its source, failed",
    }
    later = PretendingWorkers(folder)
    run_experiment(folder, later)
    assert later.taken == ["ours-burger-s0-none", "system-burger-s0-none"]


def test_error_is_written_down_and_goes_when_mended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = make_folder(tmp_path / "out", "expert")
    cell = folder.experiment().cells[0]
    monkeypatch.setattr(running, "_run", _raise(ConfigurationError("no such thing")))
    assert running.work(folder.path, cell).error == "no such thing"
    monkeypatch.setattr(running, "_run", _raise(ZeroDivisionError("by zero")))
    assert running.work(folder.path, cell).error == "ZeroDivisionError: by zero"
    assert "Traceback" in (folder.cell(cell) / ERROR).read_text()
    monkeypatch.setattr(running, "_run", lambda folder, cell: None)
    assert running.work(folder.path, cell) == CellOutcome(cell)
    assert not (folder.cell(cell) / ERROR).exists()


def _raise(error: Exception):  # type: ignore[no-untyped-def]
    def run(folder: ExperimentFolder, cell: Cell) -> None:
        raise error

    return run


def test_real_cells_in_this_process(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "out", "expert")
    with open_workers(folder.path, 1) as team:
        assert isinstance(team, OwnProcess)
        outcomes = run_experiment(folder, team)
    assert [o.error for o in outcomes] == ["", ""]
    results = tuple(folder.results())
    assert [r.cell.seed for r in results] == [0, 1]
    for result in results:
        assert [p.solved for p in result.problems] == [True, True]
        assert result.exact is not None
        assert result.exact["precision"] == result.exact["recall"] == 1.0
        assert result.efficiency is None
        assert CellResult.read(folder.cell(result.cell)) == result


def test_interrupted_cell_solves_only_what_is_left(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "out", "expert")
    cell = folder.experiment().cells[0]
    running.work(folder.path, cell)
    (folder.cell(cell) / RESULT).unlink()
    record = folder.cell(cell) / "problems.jsonl"
    first = record.read_text().splitlines()[0]
    record.write_text(first + "\n" + '{"problem": "impos')  # cut short in the middle of a line
    running.work(folder.path, cell)
    lines = record.read_text().splitlines()
    assert len(lines) == 2
    assert lines[0] == first
    assert folder.is_finished(cell)


def test_killed_process_costs_an_attempt(tmp_path: Path) -> None:
    processes = Processes(tmp_path, 2, crash_once)
    cells = [Cell("ours", "burger", seed, "none") for seed in range(3)]
    for cell in cells:
        processes.submit(cell)
    outcomes = [processes.next() for _ in cells]
    processes.close()
    assert {o.cell for o in outcomes} == set(cells)
    assert not any(o.error for o in outcomes)
    assert all((tmp_path / cell.name).exists() for cell in cells)
    assert (tmp_path / "crashed-1").exists()


def test_processes_that_are_stopped_close_what_is_open_and_leave_nobody(tmp_path: Path) -> None:
    """As long as a cell took, an interrupted experiment once waited for it.

    They get as long as a busy machine needs: nobody waits for the whole of it.
    """
    processes = at_work(tmp_path, Processes(tmp_path, 2, take_long, grace=40.0))
    processes.stop()
    assert not list(tmp_path.iterdir())
    assert not multiprocessing.active_children()


def test_processes_that_do_not_end_are_ended(tmp_path: Path) -> None:
    processes = at_work(tmp_path, Processes(tmp_path, 2, never_end, grace=0.1))
    began = time.monotonic()
    processes.stop()
    assert time.monotonic() - began < 40
    assert not multiprocessing.active_children()


def at_work(path: Path, processes: Processes) -> Processes:
    """Two cells that have begun, and one that waits."""
    for seed in range(3):
        processes.submit(Cell("ours", "burger", seed, "none"))
    latest = time.monotonic() + 40
    while len(list(path.iterdir())) < 2:
        assert time.monotonic() < latest
        time.sleep(0.01)
    return processes


@pytest.mark.slow
def test_cell_that_always_kills_its_process(tmp_path: Path) -> None:
    processes = Processes(tmp_path, 1, crash_once)
    processes.submit(Cell("ours", "burger", 9, "none"))
    assert processes.next().error == "its process was killed again and again"
    processes.close()

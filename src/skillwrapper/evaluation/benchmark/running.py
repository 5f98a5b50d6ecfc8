"""Running an experiment: every cell once, sources first."""

from __future__ import annotations

import traceback
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from functools import lru_cache
from pathlib import Path

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import InternalError, SkillWrapperError
from skillwrapper.evaluation.benchmark.cells import run_cell
from skillwrapper.evaluation.benchmark.experiment_folder import ERROR, ExperimentFolder
from skillwrapper.evaluation.benchmark.processes import Processes
from skillwrapper.evaluation.benchmark.workers import CellOutcome, Workers
from skillwrapper.evaluation.exact.exact_states import ExactStates
from skillwrapper.evaluation.methods.cell import Cell, domain_key
from skillwrapper.evaluation.methods.method import CellContext
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.files.writing import remove_leftovers, write_atomically
from skillwrapper.redaction import without_secrets


def run_experiment(
    folder: ExperimentFolder,
    workers: Workers,
    started: Callable[[Cell], None] = lambda cell: None,
    ended: Callable[[CellOutcome], None] = lambda outcome: None,
) -> tuple[CellOutcome, ...]:
    """Run all cells that are not finished yet.

    Args:
        folder: of the experiment.
        workers: who run the cells.
        started: told of every cell that is handed to the workers.
        ended: told of every cell that has ended.

    Returns:
        The cells that ran now, in the order of their end; a failed one does not stop the others.
    """
    experiment = folder.experiment()
    waiting = [cell for cell in experiment.cells if not folder.is_finished(cell)]
    outcomes: list[CellOutcome] = []
    running = 0
    while waiting or running:
        failed = {o.cell for o in outcomes if o.error}
        for cell in list(waiting):
            source = experiment.source_of(cell)
            if source in failed:
                waiting.remove(cell)
                outcomes.append(CellOutcome(cell, f"{source.name}, its source, failed"))
                ended(outcomes[-1])
            elif source is None or folder.is_finished(source):
                waiting.remove(cell)
                workers.submit(cell)
                started(cell)
                running += 1
        if running:
            outcomes.append(workers.next())
            ended(outcomes[-1])
            running -= 1
    return tuple(outcomes)


def work(path: Path, cell: Cell) -> CellOutcome:
    """Run one cell; whatever goes wrong in it ends up in its folder and in the outcome."""
    folder = ExperimentFolder(path)
    error_file = folder.cell(cell) / ERROR
    remove_leftovers(folder.cell(cell))  # of a process that was killed at this cell
    try:
        _run(folder, cell)
    except Exception as error:  # one broken cell must not take the others along
        ours = isinstance(error, SkillWrapperError)
        told = without_secrets(str(error) if ours else f"{type(error).__name__}: {error}")
        write_atomically(error_file, f"{told}\n\n{without_secrets(traceback.format_exc())}")
        return CellOutcome(cell, told)
    error_file.unlink(missing_ok=True)
    return CellOutcome(cell)


def _run(folder: ExperimentFolder, cell: Cell) -> None:
    experiment = folder.experiment()
    source = experiment.source_of(cell)
    package = find_domain(cell.domain)
    with closing(package.make_environment()) as environment:
        context = CellContext(
            cell=cell,
            settings=experiment.settings,
            folder=folder.cell(cell),
            source=folder.cell(source) if source else None,
            environment=environment,
            package=package,
            exact=_exact_states(cell.domain, folder.truth / domain_key(cell.domain)),
        )
        run_cell(METHODS[cell.method], context, folder.problems(cell.domain))


# All pictures of a domain, drawn and read, serve every cell that a process runs.
@lru_cache(maxsize=2)
def _exact_states(domain: str, folder: Path) -> ExactStates:
    return ExactStates.of(find_domain(domain), folder)


class OwnProcess:
    """Runs cells one after the other, here.

    Args:
        path: folder of the experiment.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._cells: deque[Cell] = deque()

    def submit(self, cell: Cell) -> None:
        """Take a cell on."""
        self._cells.append(cell)

    def next(self) -> CellOutcome:
        """Run the next cell."""
        return work(self._path, self._cells.popleft())


@contextmanager
def open_workers(path: Path, count: int) -> Iterator[Workers]:
    """Workers on this machine.

    Args:
        path: folder of the experiment.
        count: how many cells at a time, at least 1.
    """
    if count < 1:
        raise InternalError(f"expected at least 1 worker, got {count}; please report it")
    if count == 1:
        yield OwnProcess(path)
        return
    processes = Processes(path, count, work)
    try:
        yield processes
    except BaseException:
        processes.stop()
        raise
    processes.close()

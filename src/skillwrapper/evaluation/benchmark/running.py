"""Running an experiment: every cell once, those first that others learn from."""

from __future__ import annotations

from collections.abc import Callable

from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.workers import CellOutcome, Workers
from skillwrapper.evaluation.methods.method import Cell


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

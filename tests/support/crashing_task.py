"""Tasks that kill their own process, or take too long."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path

from skillwrapper.evaluation.benchmark.workers import CellOutcome
from skillwrapper.evaluation.methods.cell import Cell


def crash_once(path: Path, cell: Cell) -> CellOutcome:
    """Seed 1 is killed once, seed 9 always; all others leave a file behind."""
    path.mkdir(parents=True, exist_ok=True)
    mark = path / f"crashed-{cell.seed}"
    if cell.seed == 9 or (cell.seed == 1 and not mark.exists()):
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    (path / cell.name).touch()
    return CellOutcome(cell)


def take_long(path: Path, cell: Cell) -> CellOutcome:
    """Leaves a file behind as long as it is at work."""
    open_file = path / cell.name
    try:
        open_file.touch()  # in here: whoever sees the file may end us in the next moment
        time.sleep(60)
    finally:
        open_file.unlink()
    return CellOutcome(cell)


def never_end(path: Path, cell: Cell) -> CellOutcome:
    """Goes on whatever it is told."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    (path / cell.name).touch()
    time.sleep(60)
    return CellOutcome(cell)

"""Running the cells of an experiment on a Ray cluster.

The folder of the experiment must be on a file system that all machines of the cluster share.
"""

from __future__ import annotations

import importlib
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from skillwrapper.errors import ConfigurationError, MissingDependencyError
from skillwrapper.evaluation.benchmark.running import work
from skillwrapper.evaluation.benchmark.workers import CellOutcome, Task, Workers
from skillwrapper.evaluation.methods.cell import Cell

_LOCAL = "local"
_SLICE = 0.25
_RETRIES = 3
"""How often Ray runs a cell again whose worker was killed."""


class RayWorkers:
    """Runs cells as Ray tasks, each with one core.

    Args:
        path: folder of the experiment.
        ray: the module.
        task: runs a cell; importable by its name on all machines.
    """

    def __init__(self, path: Path, ray: Any, task: Task = work) -> None:
        self._path, self._ray = path.resolve(), ray
        self._task = ray.remote(num_cpus=1, max_retries=_RETRIES)(task)
        self._cells: dict[Any, Cell] = {}

    def submit(self, cell: Cell) -> None:
        """Take a cell on."""
        self._cells[self._task.remote(self._path, cell)] = cell

    def next(self) -> CellOutcome:
        """Wait for the next cell to end."""
        done: list[Any] = []
        while not done:  # in slices: a signal is only heeded between two of them
            done, _ = self._ray.wait(list(self._cells), num_returns=1, timeout=_SLICE)
        cell = self._cells.pop(done[0])
        try:
            outcome: CellOutcome = self._ray.get(done[0])
        except self._ray.exceptions.RayError as error:
            return CellOutcome(cell, f"Ray: {str(error).splitlines()[0]}")
        return outcome


@contextmanager
def _signals_kept() -> Iterator[None]:
    """Put back who heeds signals: Ray takes SIGTERM for itself, and then ends without a word."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        if threading.current_thread() is threading.main_thread():
            for number, handler in before.items():
                signal.signal(number, handler)


@contextmanager
def open_ray_workers(path: Path, address: str) -> Iterator[Workers]:
    """Workers of a Ray cluster.

    Args:
        path: folder of the experiment.
        address: as for ``ray.init``: ``auto``, ``local``, or ``ray://host:port``.

    Raises:
        MissingDependencyError: if Ray is not installed.
        ConfigurationError: if there is no cluster at the address.
    """
    try:
        ray = importlib.import_module("ray")
    except ImportError as error:
        raise MissingDependencyError("Ray", "pip install 'skillwrapper[ray]'") from error
    mine = not ray.is_initialized()
    if mine:
        options = {"include_dashboard": False} if address == _LOCAL else {}
        try:
            with _signals_kept():
                ray.init(address=address, log_to_driver=False, configure_logging=False, **options)
        except Exception as error:  # where it cannot start, Ray raises just that
            raise ConfigurationError(f"--ray {address}: found no Ray cluster ({error})") from error
    try:
        yield RayWorkers(path, ray)
    finally:
        if mine:
            ray.shutdown()

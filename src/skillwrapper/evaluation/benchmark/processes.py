"""Cells in processes of their own, which end when we do, however we end.

A process begins with loading this file, so it loads nothing that only some tasks need.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import time
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from types import FrameType

from skillwrapper.evaluation.benchmark.workers import CellOutcome, Task
from skillwrapper.evaluation.methods.cell import Cell

_RETRIES = 3
"""How often a cell is tried again whose process was killed."""
_GRACE = 1.0


class Processes:
    """Runs cells in processes of their own; a killed process costs its cell another attempt.

    Args:
        path: folder of the experiment.
        count: how many at a time.
        task: runs a cell; importable by its name.
        grace: seconds that processes get to close what is open when they are stopped.
    """

    def __init__(self, path: Path, count: int, task: Task, grace: float = _GRACE) -> None:
        self._path, self._count, self._task, self._grace = path, count, task, grace
        self._pool = self._make_pool()
        self._futures: dict[Future[CellOutcome], Cell] = {}
        self._failures: dict[Cell, int] = {}

    def submit(self, cell: Cell) -> None:
        """Take a cell on."""
        try:
            self._futures[self._submit(cell)] = cell
        except BrokenProcessPool:
            self._restart()
            self._futures[self._submit(cell)] = cell

    def next(self) -> CellOutcome:
        """Wait for the next cell to end."""
        while True:
            done = next(iter(wait(self._futures, return_when=FIRST_COMPLETED).done))
            cell = self._futures.pop(done)
            try:
                return done.result()
            except BrokenProcessPool:
                self._failures[cell] = self._failures.get(cell, 0) + 1
                if self._failures[cell] > _RETRIES:
                    return CellOutcome(cell, "its process was killed again and again")
                self.submit(cell)

    def close(self) -> None:
        """Let no further cell begin, and wait for those that run."""
        self._pool.shutdown(cancel_futures=True)

    def stop(self) -> None:
        """End all cells at once; nothing of them stays half-written."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        children = multiprocessing.active_children()
        for child in children:
            child.terminate()
        latest = time.monotonic() + self._grace
        for child in children:
            child.join(max(0.0, latest - time.monotonic()))
        for child in multiprocessing.active_children():  # also one that began meanwhile
            child.kill()
            child.join()

    def _submit(self, cell: Cell) -> Future[CellOutcome]:
        return self._pool.submit(_in_order, self._task, self._path, cell)

    def _restart(self) -> None:
        self._pool.shutdown(wait=False)
        self._pool = self._make_pool()

    def _make_pool(self) -> ProcessPoolExecutor:
        # Spawned, not forked: a forked child would share the threads' locks of its parent.
        context = multiprocessing.get_context("spawn")
        return ProcessPoolExecutor(self._count, mp_context=context, initializer=_heed_our_end)


def _heed_our_end() -> None:
    """In a worker: close what is open and end when it is told to, or its parent is gone.

    Ctrl-C on a terminal reaches everybody; who began the workers then stops them.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _end)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_outlive, args=(parent,), daemon=True).start()


def _in_order(task: Task, path: Path, cell: Cell) -> CellOutcome:
    """In a worker: run a cell; when it is told to end, take no other one."""
    try:
        return task(path, cell)
    except SystemExit as ended:
        os._exit(ended.code if isinstance(ended.code, int) else 1)


def _end(number: int, frame: FrameType | None) -> None:
    signal.signal(number, signal.SIG_IGN)  # once is enough: what follows is closing
    sys.exit(128 + number)


def _outlive(parent: multiprocessing.process.BaseProcess) -> None:
    parent.join()
    os.kill(os.getpid(), signal.SIGTERM)  # to the process: its main thread may be waiting

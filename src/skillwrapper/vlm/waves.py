"""Independent calls in flight at the same time, with results in the order of the tasks.

A wave ends early on an interruption (Ctrl-C), and on the first task that fails: waits between
attempts end at once, no call is begun any more, and calls in flight get a moment to come to their
end, so that what they bring is kept. Whoever then still waits for a server is left behind.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from queue import Empty, SimpleQueue
from typing import Generic, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

_GRACE = 0.5
"""Seconds that calls in flight get when a wave ends early."""


_SLICE = 0.25


class WaveStoppedError(Exception):
    """The wave of the calling thread has ended; only ever seen inside its workers."""


def run_wave(work: Callable[[Task], Result], tasks: Sequence[Task], parallel: int) -> list[Result]:
    """Do all tasks, up to ``parallel`` at a time; without threads if one at a time.

    The first task that fails ends the wave; of several that have failed by then, the first in the
    order of the tasks decides which exception is raised.
    """
    if parallel <= 1 or len(tasks) <= 1:
        return [work(task) for task in tasks]
    return _Wave(work, tasks).run(min(parallel, len(tasks)))


def pause(seconds: float) -> None:
    """Wait; in a worker of a wave, at most until the wave ends.

    Raises:
        WaveStoppedError: if the wave has ended.
    """
    worker = threading.current_thread()
    if not isinstance(worker, _Worker):
        time.sleep(seconds)
    elif worker.stopped.wait(seconds):
        raise WaveStoppedError


def go_on() -> None:
    """Make sure that nothing is begun in a wave that has ended.

    Raises:
        WaveStoppedError: if the wave of the calling worker has ended.
    """
    worker = threading.current_thread()
    if isinstance(worker, _Worker) and worker.stopped.is_set():
        raise WaveStoppedError


class _Worker(threading.Thread):
    def __init__(self, target: Callable[[], None], stopped: threading.Event, number: int) -> None:
        # Daemons: the interpreter does not wait for a server that does not answer.
        super().__init__(target=target, name=f"model-call-{number}", daemon=True)
        self.stopped = stopped


class _Wave(Generic[Task, Result]):
    def __init__(self, work: Callable[[Task], Result], tasks: Sequence[Task]) -> None:
        self._work, self._tasks = work, tasks
        self._waiting: SimpleQueue[int] = SimpleQueue()
        self._results: SimpleQueue[tuple[int, Result]] = SimpleQueue()
        self._failures: dict[int, BaseException] = {}
        self._ended: SimpleQueue[None] = SimpleQueue()
        self._stopped = threading.Event()
        self._left = len(tasks)

    def run(self, parallel: int) -> list[Result]:
        for number in range(len(self._tasks)):
            self._waiting.put(number)
        workers = [_Worker(self._work_on, self._stopped, n) for n in range(parallel)]
        try:
            for worker in workers:
                worker.start()
            while self._left and not self._failures:
                self._wait_for_one()
        except BaseException:
            self._stop(workers)
            raise
        if self._failures:
            self._stop(workers)
            raise self._failures[min(self._failures)]
        return self._in_order()

    def _wait_for_one(self) -> None:
        # In slices: a signal that another thread gets does not wake this one, but must be handled.
        try:
            self._ended.get(timeout=_SLICE)
            self._left -= 1
        except Empty:
            return

    def _work_on(self) -> None:
        while not self._stopped.is_set():
            try:
                number = self._waiting.get_nowait()
            except Empty:
                return
            try:
                self._results.put((number, self._work(self._tasks[number])))
            except WaveStoppedError:
                return
            except BaseException as error:
                self._failures[number] = error
                self._stopped.set()
            self._ended.put(None)

    def _stop(self, workers: Sequence[_Worker]) -> None:
        self._stopped.set()
        latest = time.monotonic() + _GRACE
        for worker in workers:
            if worker.is_alive():
                worker.join(max(0.0, latest - time.monotonic()))

    def _in_order(self) -> list[Result]:
        found = dict(self._results.get_nowait() for _ in self._tasks)
        return [found[number] for number in range(len(self._tasks))]

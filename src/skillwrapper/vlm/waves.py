"""Independent calls in flight at the same time, with results in the order of the tasks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")


def run_wave(work: Callable[[Task], Result], tasks: Sequence[Task], parallel: int) -> list[Result]:
    """Do all tasks, up to ``parallel`` at a time; without threads if one at a time.

    The first task that fails, in the order of the tasks, decides which exception is raised;
    tasks not yet begun are then dropped.
    """
    if parallel <= 1 or len(tasks) <= 1:
        return [work(task) for task in tasks]
    with ThreadPoolExecutor(min(parallel, len(tasks)), thread_name_prefix="model-call") as pool:
        futures = [pool.submit(work, task) for task in tasks]
        try:
            return [future.result() for future in futures]
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise

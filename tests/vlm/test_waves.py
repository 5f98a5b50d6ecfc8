"""Calls in flight together: order, failures, and that nothing outlives its wave for long."""

from __future__ import annotations

import threading
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillwrapper.vlm.waves import WaveStoppedError, go_on, pause, run_wave


@given(st.lists(st.integers(), max_size=30), st.integers(1, 8))
def test_results_come_in_the_order_of_the_tasks(tasks: list[int], parallel: int) -> None:
    assert run_wave(lambda task: task + 1, tasks, parallel) == [task + 1 for task in tasks]


def test_tasks_run_at_the_same_time() -> None:
    together = threading.Barrier(4, timeout=5)
    assert len(run_wave(lambda _: together.wait(), range(4), 4)) == 4


def test_the_first_failure_ends_the_waits_of_the_others() -> None:
    began, stopped = time.monotonic(), []
    together = threading.Barrier(8, timeout=5)

    def work(task: int) -> int:
        together.wait()
        if task == 5:
            raise ValueError("five")
        try:
            pause(60)
        except WaveStoppedError:
            stopped.append(task)
            raise
        return task

    with pytest.raises(ValueError, match="five"):
        run_wave(work, range(20), 8)
    assert time.monotonic() - began < 1.5
    assert sorted(stopped) == [0, 1, 2, 3, 4, 6, 7]


def test_what_is_in_flight_may_come_to_its_end_and_nothing_is_begun() -> None:
    finished = []

    def work(task: int) -> None:
        if task == 0:
            time.sleep(0.05)
            raise ValueError("zero")
        time.sleep(0.3)
        finished.append(task)
        go_on()
        finished.append(-task)

    with pytest.raises(ValueError, match="zero"):
        run_wave(work, range(9), 3)
    assert sorted(finished) == [1, 2]


def test_who_does_not_end_is_left_behind() -> None:
    release, began = threading.Event(), time.monotonic()

    def work(task: int) -> None:
        if task == 0:
            raise ValueError("zero")
        release.wait(30)

    with pytest.raises(ValueError, match="zero"):
        run_wave(work, range(3), 3)
    assert time.monotonic() - began < 1.9
    release.set()


def test_an_interruption_ends_a_wave() -> None:
    """As Ctrl-C does it: raised in the main thread while workers wait for a retry."""
    threading.Timer(0.2, _interrupt).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        run_wave(lambda _: pause(60), range(16), 8)
    assert time.monotonic() - began < 1.9


def _interrupt() -> None:
    import signal  # noqa: PLC0415

    signal.raise_signal(signal.SIGINT)


def test_outside_of_a_wave_a_pause_is_a_sleep() -> None:
    go_on()
    pause(0.001)

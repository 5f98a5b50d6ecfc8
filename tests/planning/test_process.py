"""Nothing of a program outlives its time limit, its block, or us; nothing of it can hold us up.

From faults found by use: a grandchild that held standard output kept us waiting far past the limit,
and a planner ran on after we had been terminated.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from skillwrapper.planning import process
from skillwrapper.planning.process import Finished, Scratch

PARENT_OF_A_SLEEPER = """
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
open({pid!r}, "w").write(str(child.pid))
print("started", flush=True)
{rest}
"""


@pytest.fixture(autouse=True)
def temporary(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Where temporary folders are made in a test."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def run(program: str, text: str = "", seconds: float = 20.0) -> Finished:
    with Scratch.made("test-") as scratch:
        return scratch.run([sys.executable, "-c", program], text=text, seconds=seconds)


def is_running(number: int) -> bool:
    try:
        state = (
            Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
        )
    except OSError:
        return False
    return state != "Z"


def comes_true(condition: Callable[[], bool], seconds: float = 2.0) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False


def ends_soon(number: int) -> bool:
    return comes_true(lambda: not is_running(number))


def test_input_and_output(temporary: Path) -> None:
    program = "import sys; print(sys.stdin.read().upper()); print('oh', file=sys.stderr); exit(3)"
    finished = run(program, "hello")
    assert (finished.code, finished.timed_out) == (3, False)
    assert set(finished.output.split()) == {"HELLO", "oh"}
    assert not list(temporary.iterdir())


@pytest.mark.parametrize("rest", ["time.sleep(60)", "sys.stdout.close(); time.sleep(60)"])
def test_the_whole_group_is_killed_on_time_out(tmp_path: Path, rest: str) -> None:
    pid = tmp_path / "pid"
    started = time.monotonic()
    finished = run(PARENT_OF_A_SLEEPER.format(pid=str(pid), rest=rest), seconds=0.8)
    assert finished.timed_out
    assert time.monotonic() - started < 1.8
    assert "started" in finished.output
    assert ends_soon(int(pid.read_text()))


def test_a_grandchild_that_holds_the_output_does_not_keep_us(tmp_path: Path) -> None:
    pid = tmp_path / "pid"
    started = time.monotonic()
    finished = run(PARENT_OF_A_SLEEPER.format(pid=str(pid), rest=""))
    assert (finished.code, finished.timed_out) == (0, False)
    assert time.monotonic() - started < 2
    assert ends_soon(int(pid.read_text()))


def test_a_grandchild_in_a_session_of_its_own_does_not_keep_us(tmp_path: Path) -> None:
    pid = tmp_path / "pid"
    program = PARENT_OF_A_SLEEPER.replace('60)"]', '60)"], start_new_session=True')
    started = time.monotonic()
    finished = run(program.format(pid=str(pid), rest="time.sleep(60)"), seconds=0.5)
    assert finished.timed_out
    assert time.monotonic() - started < 1.5
    os.kill(int(pid.read_text()), signal.SIGKILL)  # this one we cannot find


def test_only_the_end_of_much_output_is_kept() -> None:
    finished = run("print('first'); print('x' * 3_000_000); print('last')")
    assert finished.output.endswith("last\n")
    assert len(finished.output) <= 100_000


def test_output_that_is_no_text() -> None:
    assert "\ufffd" in run("import os; os.write(1, bytes(range(256)))").output


def test_a_program_that_fills_the_disk_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "_MOST_WRITTEN", 1_000_000)
    finished = run("while True: print('x' * 10_000)")
    assert finished.wrote_too_much


OURS = """
import signal, sys, tempfile
from pathlib import Path
from skillwrapper.planning.process import Scratch
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # ignored under nohup, and that is inherited
tempfile.tempdir = sys.argv[1]
with Scratch.made("test-") as scratch:
    scratch.run([sys.executable, "-c", sys.argv[2]], text="", seconds=60)
"""


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_nothing_outlives_us(tmp_path: Path, temporary: Path, ending: signal.Signals) -> None:
    pid = tmp_path / "pid"
    program = PARENT_OF_A_SLEEPER.format(pid=str(pid), rest="time.sleep(60)")
    with subprocess.Popen(
        [sys.executable, "-c", OURS, str(temporary), program],
        stderr=subprocess.DEVNULL,
    ) as ours:
        assert comes_true(lambda: pid.is_file() and pid.read_text() != "", seconds=20)
        assert list(temporary.iterdir())
        ours.send_signal(ending)
        ours.wait(5)
    assert ends_soon(int(pid.read_text()))
    assert comes_true(lambda: not list(temporary.iterdir()))


def test_program_that_does_not_exist(temporary: Path) -> None:
    with pytest.raises(FileNotFoundError), Scratch.made("test-") as scratch:
        scratch.run(["/nowhere/planner"], text="", seconds=1)
    assert not list(temporary.iterdir())

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

from skillwrapper.planning.process import run_to_end

PARENT_OF_A_SLEEPER = """
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
open("pid", "w").write(str(child.pid))
print("started", flush=True)
{rest}
"""


def is_running(number: int) -> bool:
    try:
        state = (
            Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
        )
    except OSError:
        return False
    return state != "Z"


def ends_soon(number: int) -> bool:
    for _ in range(100):
        if not is_running(number):
            return True
        time.sleep(0.02)
    os.kill(number, 9)
    return False


def test_input_and_output(tmp_path: Path) -> None:
    program = "import sys; print(sys.stdin.read().upper()); print('oh', file=sys.stderr); exit(3)"
    finished = run_to_end(
        [sys.executable, "-c", program], folder=tmp_path, text="hello", seconds=20
    )
    assert (finished.code, finished.timed_out) == (3, False)
    assert set(finished.output.split()) == {"HELLO", "oh"}


def test_the_whole_group_is_killed_on_time_out(tmp_path: Path) -> None:
    program = PARENT_OF_A_SLEEPER.format(rest="time.sleep(60)")
    started = time.monotonic()
    finished = run_to_end([sys.executable, "-c", program], folder=tmp_path, text="", seconds=1.0)
    assert finished.timed_out
    assert time.monotonic() - started < 10
    assert "started" in finished.output
    assert ends_soon(int((tmp_path / "pid").read_text()))


def test_helpers_that_outlive_the_program_are_killed(tmp_path: Path) -> None:
    # The sleeper holds no pipe, so the program's own end is what we see first.
    program = PARENT_OF_A_SLEEPER.replace(
        '"import time; time.sleep(60)"]', '"import time; time.sleep(60)"], stdout=-3, stderr=-3'
    )
    finished = run_to_end(
        [sys.executable, "-c", program.format(rest="")], folder=tmp_path, text="", seconds=20
    )
    assert (finished.code, finished.timed_out) == (0, False)
    assert ends_soon(int((tmp_path / "pid").read_text()))

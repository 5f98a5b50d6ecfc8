"""Running a program so that nothing of it outlives its time limit."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Finished:
    """A program that has ended.

    Attributes:
        code: its exit code; negative if a signal ended it.
        output: what it printed, errors included.
        timed_out: whether it was killed for taking too long.
    """

    code: int
    output: str
    timed_out: bool


def run_to_end(command: Sequence[str], *, folder: Path, text: str, seconds: float) -> Finished:
    """Run a program in a process group of its own, and kill the whole group in the end.

    Args:
        command: the program and its arguments.
        folder: the folder it runs in.
        text: what it reads from standard input.
        seconds: how long it may take.
    """
    process = subprocess.Popen(
        command,
        cwd=folder,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    with process:
        try:
            output, _ = process.communicate(text, timeout=seconds)
        except subprocess.TimeoutExpired:
            _kill_group(process.pid)
            output, _ = process.communicate()
            return Finished(process.returncode, output, timed_out=True)
        finally:
            # Also on an interrupt, and for helpers that outlive the program itself.
            _kill_group(process.pid)
    return Finished(process.returncode, output, timed_out=False)


def _kill_group(number: int) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(number, signal.SIGKILL)

"""Running a program so that nothing of it outlives its time limit, or us.

The program writes into files, never into pipes: whoever holds a pipe open could keep us waiting.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

_OUTPUT, _INPUT = "output.txt", "input.txt"
_OUTPUT_KEPT = 100_000
"""So many bytes of the end of what a program prints are kept."""
_MOST_WRITTEN = 1 << 28
"""A program that writes more bytes than this is stopped."""
_LOOK_EVERY = 0.2
"""Seconds between two looks at how much has been written."""

_GUARD = 'read -r group; read -r _; [ -z "$group" ] || kill -s KILL -- "-$group"; rm -rf -- "$1"'
"""Waits until we close its input or are gone, then kills the program and removes the folder."""


@dataclass(frozen=True)
class Finished:
    """A program that has ended.

    Attributes:
        code: its exit code; negative if a signal ended it.
        output: the end of what it printed, errors included.
        timed_out: whether it was killed for taking too long.
        wrote_too_much: whether it was killed for filling the disk.
    """

    code: int
    output: str
    timed_out: bool = False
    wrote_too_much: bool = False


@dataclass(frozen=True)
class Scratch:
    """A temporary folder for one program.

    The folder and everything that the program started are gone when the block is left, also
    where we are interrupted or killed: a guard of two lines of shell sees to it.

    Attributes:
        folder: the folder.
    """

    folder: Path
    _guard: subprocess.Popen[bytes]

    @classmethod
    @contextmanager
    def made(cls, prefix: str) -> Iterator[Scratch]:
        """Make one.

        Args:
            prefix: the beginning of the folder's name.

        Raises:
            OSError: if there is no room for it.
        """
        folder = tempfile.mkdtemp(prefix=prefix)
        try:
            guard = subprocess.Popen(
                ["/bin/sh", "-c", _GUARD, "guard", folder],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        except OSError:
            Path(folder).rmdir()
            raise
        with guard:  # closes its input and waits for it
            yield cls(Path(folder), guard)

    def run(self, command: Sequence[str], *, text: str, seconds: float) -> Finished:
        """Run a program, once, in a process group of its own.

        Args:
            command: the program and its arguments.
            text: what it reads from standard input.
            seconds: how long it may take.

        Raises:
            OSError: if it cannot be started.
        """
        deadline = time.monotonic() + seconds
        (self.folder / _INPUT).write_text(text, encoding="utf-8")
        with (
            (self.folder / _INPUT).open("rb") as source,
            (self.folder / _OUTPUT).open("w+b") as out,
        ):
            process = subprocess.Popen(
                command,
                cwd=self.folder,
                stdin=source,
                stdout=out,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            timed_out = wrote_too_much = False
            try:
                self._watch_over(process)
                while _is_running(process, deadline) and not timed_out and not wrote_too_much:
                    timed_out = time.monotonic() >= deadline
                    wrote_too_much = self._written() > _MOST_WRITTEN
            finally:
                process.kill()
                process.wait()
            return Finished(process.returncode, _end_of(out), timed_out, wrote_too_much)

    def _watch_over(self, process: subprocess.Popen[bytes]) -> None:
        if self._guard.stdin is not None:
            self._guard.stdin.write(f"{process.pid}\n".encode())
            self._guard.stdin.flush()

    def _written(self) -> int:
        sizes = 0
        for path in self.folder.iterdir():
            with suppress(OSError):
                sizes += path.stat().st_size
        return sizes


def _end_of(file: BinaryIO) -> str:
    size = file.seek(0, os.SEEK_END)
    file.seek(max(0, size - _OUTPUT_KEPT))
    return file.read(_OUTPUT_KEPT).decode("utf-8", errors="replace")


def _is_running(process: subprocess.Popen[bytes], deadline: float) -> bool:
    """Whether a program still runs after a short while, at the latest at a deadline."""
    try:
        process.wait(min(_LOOK_EVERY, max(0.0, deadline - time.monotonic())))
    except subprocess.TimeoutExpired:
        return True
    return False

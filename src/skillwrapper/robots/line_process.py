"""A process that is spoken to in lines, with a time limit on every answer."""

from __future__ import annotations

import contextlib
import os
import selectors
import shlex
import signal
import subprocess
import sys
import threading
import time
from typing import IO

from skillwrapper.errors import ConfigurationError, RobotError
from skillwrapper.files.mistakes import shorten
from skillwrapper.redaction import without_secrets

_LONGEST_LINE = 256 * 2**20
_GRACE = 3.0
"""Seconds to end by itself."""
_LAST_WORDS = 0.5
"""Seconds to wait for what it said last; whatever it started may hold its standard error."""
_LONGEST_SAID = 2**16


class LineProcess:
    """Starts a command and speaks to it; what it says on standard error is passed on, redacted.

    Args:
        command: as in a shell, without any of a shell's own signs; runs in the present folder.

    Raises:
        ConfigurationError: if there is no such command.
    """

    def __init__(self, command: str) -> None:
        self._name = f"robot {shorten(repr(command))}"
        self._process = _start(command, self._name)
        self._said = threading.Thread(target=_pass_on, args=(self._process.stderr,), daemon=True)
        self._said.start()
        self._received = bytearray()
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._output, selectors.EVENT_READ)

    def ask(self, line: str, what: str, limit: float) -> bytes:
        """Send a line, and wait for the line that answers it.

        Args:
            line: without its end.
            what: the call, for messages.
            limit: seconds to wait.

        Raises:
            RobotError: if the process has ended, says nothing in time, or more than a line can be.
        """
        entrance = self._process.stdin
        try:
            if entrance is None:
                raise BrokenPipeError
            entrance.write(line.encode("utf-8") + b"\n")
            entrance.flush()
        except (BrokenPipeError, ValueError, OSError) as error:
            raise self._ended(what) from error
        return self._read_line(what, time.monotonic() + limit, limit)

    def close(self, patience: float = _GRACE) -> None:
        """End the process and what it started: let it, ask it, make it.

        Args:
            patience: seconds to wait for each of the first two.
        """
        with contextlib.suppress(OSError):
            if self._process.stdin is not None:
                self._process.stdin.close()
        for sign in (None, signal.SIGTERM, signal.SIGKILL):
            if sign is not None:
                self._signal(sign)
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(patience)
                break
        self._selector.close()
        self._said.join(_LAST_WORDS)
        with contextlib.suppress(OSError):
            if self._process.stdout is not None:
                self._process.stdout.close()

    def kill(self) -> None:
        """End it at once."""
        self._signal(signal.SIGKILL)
        self._process.wait()

    @property
    def _output(self) -> int:
        stdout = self._process.stdout
        return stdout.fileno() if stdout is not None else -1

    def _read_line(self, what: str, deadline: float, limit: float) -> bytes:
        while b"\n" not in self._received:
            left = deadline - time.monotonic()
            if left <= 0 or not self._selector.select(left):
                self.kill()
                raise RobotError(
                    f"{self._name}: {what}: expected an answer within {limit:g} s, got none; it "
                    "was stopped (give more time with --robot-timeout)"
                )
            chunk = os.read(self._output, 2**16)
            if not chunk:
                raise self._ended(what)
            self._received += chunk
            if len(self._received) > _LONGEST_LINE:
                self.kill()
                raise RobotError(f"{self._name}: {what}: expected a line, got 256 MB without one")
        line, _, rest = bytes(self._received).partition(b"\n")
        self._received = bytearray(rest)
        return line

    def _ended(self, what: str) -> RobotError:
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(_GRACE)
        code = self._process.returncode
        how = "closed its output" if code is None else f"ended with exit code {code}"
        if code is not None and code < 0:
            how = f"was killed by signal {-code}"
        return RobotError(f"{self._name}: {what}: expected an answer, but the process {how}")

    def _signal(self, sign: signal.Signals) -> None:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, sign)


def _pass_on(said: IO[bytes] | None) -> None:
    """Say what a process says on standard error, until it closes that."""
    if said is None:
        return
    with said:
        while line := said.readline(_LONGEST_SAID):
            sys.stderr.write(without_secrets(line.decode("utf-8", "replace")))
            sys.stderr.flush()


def _start(command: str, name: str) -> subprocess.Popen[bytes]:
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise ConfigurationError(f"{name}: expected a command, got {error}") from error
    if not words:
        raise ConfigurationError("--robot: expected a command, got nothing")
    try:
        return subprocess.Popen(
            words,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,  # so that it ends with whatever it starts
        )
    except OSError as error:
        raise ConfigurationError(f"{name}: cannot be started ({error.strerror})") from error

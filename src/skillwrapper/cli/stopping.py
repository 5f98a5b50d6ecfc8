"""Stopping a command from outside: Ctrl-C, SIGTERM and SIGHUP.

All of them interrupt whatever the main thread does, so that what is open is closed in the usual
way: children end, temporary files go, what was finished stays. Nothing but the standard library is
imported here: signals may come while everything else is still being loaded.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Self

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_SAID = "stopped; everything that was finished is kept: run the same command again to go on"


def stoppable(work: Callable[[], object]) -> None:
    """Do what signals may end: with a sentence, and the exit code that shells give it.

    Raises:
        SystemExit: if a signal came.
    """
    with StopSignals() as stop:
        try:
            work()
        except BaseException as ended:  # whatever libraries make of an interruption
            if stop.received is None:
                raise
            print(_SAID, file=sys.stderr)  # noqa: T201
            raise SystemExit(stop.exit_code) from ended


class StoppedError(KeyboardInterrupt):
    """A signal came.

    A kind of its own, because Python ends as if by Ctrl-C, whatever exit code it is given, where a
    plain ``KeyboardInterrupt`` passes through text that is executed, as dataclasses do.
    """


class StopSignals:
    """Turns signals into ``StoppedError``, and remembers which one came.

    Attributes:
        received: the last signal; None if none came.
    """

    def __init__(self) -> None:
        self.received: signal.Signals | None = None
        self._process = os.getpid()

    def __enter__(self) -> Self:
        for number in _SIGNALS:
            if signal.getsignal(number) is not signal.SIG_IGN:  # nohup stays nohup
                signal.signal(number, self._stop)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Signals that come later, while the interpreter ends, change nothing any more."""

    @property
    def exit_code(self) -> int:
        """As shells count it: 130 for Ctrl-C, 143 for SIGTERM."""
        return 128 + (self.received or signal.SIGINT)

    def _stop(self, number: int, frame: FrameType | None) -> None:
        if os.getpid() != self._process:  # a child that was forked dies as it would without us
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)
            return
        self.received = signal.Signals(number)
        raise StoppedError

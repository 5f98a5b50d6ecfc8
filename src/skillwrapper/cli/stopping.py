"""Stopping a command from outside: Ctrl-C, SIGTERM, SIGHUP, and a limit on time.

All of them interrupt whatever the main thread does, so that what is open is closed in the usual
way: children end, temporary files go, what was finished stays.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType, TracebackType
from typing import Self

from skillwrapper.vlm.limits import time_is_up

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopSignals:
    """Turns signals into ``KeyboardInterrupt``, and remembers which one came.

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
        raise KeyboardInterrupt


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """Let a block take so long at the most, also while it waits for a server.

    Args:
        seconds: from now on; None for no limit.

    Raises:
        LimitReachedError: when the time is up, out of whatever is done then.
    """
    if seconds is None:
        yield
        return

    def stop(number: int, frame: FrameType | None) -> None:
        raise time_is_up(seconds)

    before = signal.signal(signal.SIGALRM, stop)
    # The budget of calls has the same limit and is exact; this is for what it cannot interrupt.
    signal.setitimer(signal.ITIMER_REAL, seconds + 0.5)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)

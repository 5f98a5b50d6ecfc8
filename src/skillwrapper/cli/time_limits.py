"""A limit on the time that a command takes."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from skillwrapper.vlm.limits import time_is_up


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

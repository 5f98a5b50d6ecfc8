"""Limits on what a run may spend on model calls."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from skillwrapper.errors import ConfigurationError, LimitReachedError, UnusableReplyError
from skillwrapper.usage import Usage
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, ModelWrapper, VisionLanguageModel


@dataclass(frozen=True)
class CallLimits:
    """What may be spent; None means without limit.

    Attributes:
        calls: calls made, failed ones included.
        cost: US dollars; calls of unknown cost are not counted.
        seconds: wall time since the budget was opened.

    Raises:
        ConfigurationError: if a limit is negative.
    """

    calls: int | None = None
    cost: float | None = None
    seconds: float | None = None

    def __post_init__(self) -> None:
        for name in ("calls", "cost", "seconds"):
            value = getattr(self, name)
            if value is not None and value < 0:
                raise ConfigurationError(f"'max-{name}': expected 0 or more, got {value}")


class CallBudget:
    """Counts what all models of a run spend together. Safe to use from several threads.

    Args:
        limits: what may be spent.
        clock: tells seconds; replaced in tests.
    """

    def __init__(
        self, limits: CallLimits | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._limits, self._clock = limits or CallLimits(), clock
        self._lock = threading.Lock()
        self._opened = clock()
        self._calls, self._cost = 0, 0.0

    @property
    def calls(self) -> int:
        """Calls made so far."""
        return self._calls

    @property
    def seconds_left(self) -> float | None:
        """Seconds until the limit on time is reached; None without one."""
        if self._limits.seconds is None:
            return None
        return max(0.0, self._limits.seconds - (self._clock() - self._opened))

    def open_call(self) -> None:
        """Count a call that is about to be made.

        Raises:
            LimitReachedError: if it may not be made.
        """
        limits = self._limits
        with self._lock:
            if limits.calls is not None and self._calls >= limits.calls:
                raise _reached("calls", f"{limits.calls} calls were made")
            if limits.cost is not None and self._cost >= limits.cost:
                raise _reached("cost", f"{self._cost:.2f} dollars were spent")
            if limits.seconds is not None and self.seconds_left == 0:
                raise time_is_up(limits.seconds)
            self._calls += 1

    def close_call(self, usage: Usage) -> None:
        """Count what a call has cost."""
        with self._lock:
            self._cost += usage.cost or 0.0


class LimitedModel(ModelWrapper):
    """A model that is not asked any more once a limit is reached.

    Args:
        model: what is asked.
        budget: shared by all models of a run.
    """

    def __init__(self, model: VisionLanguageModel, budget: CallBudget) -> None:
        super().__init__(model)
        self._budget = budget

    def complete(self, request: ModelRequest) -> ModelReply:
        """Ask, if that is within the limits.

        Raises:
            LimitReachedError: if it is not.
            ProviderError: as the model behind does.
        """
        self._budget.open_call()
        try:
            reply = self._model.complete(request)
        except UnusableReplyError as error:
            self._budget.close_call(error.usage or Usage())
            raise
        self._budget.close_call(reply.usage)
        return reply


def time_is_up(seconds: float) -> LimitReachedError:
    """For a limit on time that is reached."""
    return _reached("seconds", f"{seconds:g} seconds have passed")


def _reached(option: str, what: str) -> LimitReachedError:
    return LimitReachedError(
        f"limit reached: {what} (--max-{option}); everything is kept: run the same command with a "
        "higher limit to go on"
    )

"""A model that is asked again when an attempt fails in passing."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass

from skillwrapper.errors import (
    ConfigurationError,
    ModelUnavailableError,
    TemporaryProviderError,
    UnusableReplyError,
)
from skillwrapper.vlm.protocol import (
    ModelReply,
    ModelRequest,
    ModelWrapper,
    VisionLanguageModel,
)
from skillwrapper.vlm.waves import go_on, pause


@dataclass(frozen=True)
class RetryPolicy:
    """How often and after which waits a call is repeated.

    Attributes:
        attempts: in all, at least 1.
        first_wait: seconds before the second attempt; doubles with every further one.
        longest_wait: seconds; no wait is longer unless the provider asks for it.
        longest_asked_wait: seconds; if a provider asks for more, the call is given up.

    Raises:
        ConfigurationError: if there would be no attempt.
    """

    attempts: int = 12
    first_wait: float = 0.5
    longest_wait: float = 30.0
    longest_asked_wait: float = 120.0

    def __post_init__(self) -> None:
        if self.attempts < 1:
            raise ConfigurationError(f"expected at least 1 attempt, got {self.attempts}")

    def wait(self, attempt: int, asked: float | None, jitter: float) -> float:
        """Seconds to wait after a failed attempt.

        Args:
            attempt: number of the attempt that failed, from 1.
            asked: what the provider asks for, if it does.
            jitter: 0 to 1; spreads the waits of calls that failed together.
        """
        if asked is not None:
            return asked * (1 + 0.1 * jitter)
        grown = min(self.first_wait * 2.0 ** min(attempt - 1, 30), self.longest_wait)
        return grown * (0.5 + 0.5 * jitter)


class RetryingModel(ModelWrapper):
    """Repeats calls that fail in passing.

    Args:
        model: what is asked.
        policy: how often and after which waits.
        seconds_left: tells how long calls may be waited for; None for any time.
        sleep: waits; replaced in tests.
    """

    def __init__(
        self,
        model: VisionLanguageModel,
        policy: RetryPolicy | None = None,
        seconds_left: Callable[[], float | None] = lambda: None,
        sleep: Callable[[float], None] = pause,
    ) -> None:
        super().__init__(model)
        self._policy, self._seconds_left, self._sleep = policy or RetryPolicy(), seconds_left, sleep

    def complete(self, request: ModelRequest) -> ModelReply:
        """Ask until there is a reply.

        Raises:
            ModelUnavailableError: if the last attempt failed as well.
            ProviderError: at once, if another attempt would fail in the same way.
        """
        jitter = random.Random()  # spreads waits over time; never touches a result
        for attempt in range(1, self._policy.attempts + 1):
            go_on()
            try:
                return self._model.complete(request)
            except TemporaryProviderError as error:
                self._check(error, attempt)
                wait = self._policy.wait(attempt, error.retry_after, jitter.random())
                left = self._seconds_left()
                # Not past a limit on time; the next attempt then meets the limit itself.
                self._sleep(wait if left is None else min(wait, left))
        raise ModelUnavailableError(f"{self.name}: no attempt was made")

    def _check(self, error: TemporaryProviderError, attempt: int) -> None:
        """Whether to try again at all."""
        kept = "what was answered is kept, and the run can be resumed"
        if attempt == self._policy.attempts:
            raise ModelUnavailableError(
                f"{self.name}: no usable answer in {attempt} attempts; last: {error}; "
                f"{_advice(error)}; {kept}"
            ) from error
        if error.retry_after is not None and error.retry_after > self._policy.longest_asked_wait:
            raise ModelUnavailableError(
                f"{self.name}: the provider asks to wait for {error.retry_after:.0f} seconds "
                f"({error}); {kept} then"
            ) from error


def _advice(error: TemporaryProviderError) -> str:
    if isinstance(error, UnusableReplyError):
        return "reword the prompt templates or choose another model"
    return "try again later, or with fewer calls in flight"

"""A model that is asked again when an attempt fails in passing."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from dataclasses import dataclass

from skillwrapper.errors import (
    ConfigurationError,
    ModelUnavailableError,
    TemporaryProviderError,
    UnusableReplyError,
)
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, VisionLanguageModel
from skillwrapper.vlm.wrapping import ModelWrapper


@dataclass(frozen=True)
class RetryPolicy:
    """How often and after which waits a call is repeated.

    Attributes:
        attempts: in all, at least 1.
        first_wait: seconds before the second attempt; doubles with every further one.
        longest_wait: seconds; no wait is longer unless the provider asks for it.
        longest_asked_wait: seconds; the longest wait that a provider may ask for.

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
            return min(asked, self.longest_asked_wait) * (1 + 0.1 * jitter)
        grown = min(self.first_wait * 2.0 ** min(attempt - 1, 30), self.longest_wait)
        return grown * (0.5 + 0.5 * jitter)


class RetryingModel(ModelWrapper):
    """Repeats calls that fail in passing.

    Args:
        model: what is asked.
        policy: how often and after which waits.
        sleep: waits; replaced in tests.
    """

    def __init__(
        self,
        model: VisionLanguageModel,
        policy: RetryPolicy | None = None,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(model)
        self._policy, self._sleep = policy or RetryPolicy(), sleep

    def complete(self, request: ModelRequest) -> ModelReply:
        """Ask until there is a reply.

        Raises:
            ModelUnavailableError: if the last attempt failed as well.
            ProviderError: at once, if another attempt would fail in the same way.
        """
        jitter = random.Random()  # spreads waits over time; never touches a result
        for attempt in range(1, self._policy.attempts + 1):
            try:
                return self._model.complete(request)
            except TemporaryProviderError as error:
                if attempt == self._policy.attempts:
                    raise ModelUnavailableError(
                        f"{self.name}: no usable answer in {attempt} attempts; last: {error}; "
                        f"{_advice(error)}; what was answered is kept, and the run can be resumed"
                    ) from error
                self._sleep(self._policy.wait(attempt, error.retry_after, jitter.random()))
        raise ModelUnavailableError(f"{self.name}: no attempt was made")


def _advice(error: TemporaryProviderError) -> str:
    if isinstance(error, UnusableReplyError):
        return "reword the prompt templates or choose another model"
    return "try again later, or with fewer calls in flight"

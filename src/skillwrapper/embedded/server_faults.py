"""Faults that the test server can be told to have."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from enum import StrEnum

from skillwrapper.embedded.chance import Chance
from skillwrapper.errors import ConfigurationError


class Fault(StrEnum):
    """What can go wrong with a call."""

    RATE_LIMIT = "rate-limit"
    SERVER_ERROR = "server-error"
    SLOW = "slow"
    CUT = "cut"
    TRUNCATED = "truncated"
    EMPTY = "empty"
    REFUSAL = "refusal"
    NONSENSE = "nonsense"


@dataclass(frozen=True)
class FaultPlan:
    """How often calls fail, and in which ways.

    Attributes:
        rate: share of calls that fail, 0 to 1.
        kinds: the ways, all equally likely.
        seed: decides which calls fail.
        retry_after: seconds that a rate limit asks to wait.
        slowness: seconds that a slow call takes longer.

    Raises:
        ConfigurationError: if the rate is no share, or calls should fail in no way.
    """

    rate: float = 0.0
    kinds: tuple[Fault, ...] = tuple(Fault)
    seed: int = 0
    retry_after: float = 0.05
    slowness: float = 0.5

    def __post_init__(self) -> None:
        if not 0 <= self.rate <= 1:
            raise ConfigurationError(f"'faults': expected a share from 0 to 1, got {self.rate}")
        if self.rate and not self.kinds:
            raise ConfigurationError("'faults': expected at least one kind of fault, got none")


class FaultChooser:
    """Decides which calls fail: by what is asked and how often, not by the order of arrival.

    Args:
        plan: how often and in which ways.
    """

    def __init__(self, plan: FaultPlan) -> None:
        self._plan = plan
        self._asked: Counter[str] = Counter()

    def choose(self, question: str) -> Fault | None:
        """The fault of the next call with a question; None for an answer.

        Args:
            question: a digest of the call's body.
        """
        self._asked[question] += 1
        chance = Chance(self._plan.seed, "fault", question, self._asked[question])
        return chance.pick(self._plan.kinds) if chance.happens(self._plan.rate) else None

"""Faults that the test server can be told to have."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from skillwrapper.embedded.canned_errors import CANNED_ERRORS
from skillwrapper.embedded.chance import Chance
from skillwrapper.errors import ConfigurationError, UnknownNameError

RATE_LIMIT, SERVER_ERROR, SLOW, CUT = "rate-limit", "server-error", "slow", "cut"
TRUNCATED, EMPTY, REFUSAL, NONSENSE = "truncated", "empty", "refusal", "nonsense"
RATE_LIMIT_DATE, DRIP, CUT_OFF, CUT_OFF_THINKING = (
    "rate-limit-date", "drip", "cut-off", "cut-off-thinking",
)  # fmt: skip
CONTENT_PARTS, REASONING_FIELD, FILTERED = "content-parts", "reasoning-field", "filtered"
STREAMED, STREAM_CUT, BROKEN_OFF, TOOL_CALL = (
    "streamed", "stream-cut", "broken-off", "tool-call",
)  # fmt: skip
KEY_IN_ERROR, KEY_IN_REPLY = "key-in-error", "key-in-reply"
ALL_TRUE, ALL_FALSE, DEAF = "all-true", "all-false", "deaf"

PASSING = (RATE_LIMIT, SERVER_ERROR, SLOW, CUT, TRUNCATED, EMPTY, REFUSAL, NONSENSE)
"""Faults after which another attempt may work."""

FAULTS: Mapping[str, str] = MappingProxyType(
    {
        RATE_LIMIT: "status 429, says how long to wait",
        RATE_LIMIT_DATE: "status 429, says until when to wait",
        SERVER_ERROR: "status 500 without a reason",
        SLOW: "the answer comes late",
        DRIP: "the answer comes in single bytes and does not end",
        CUT: "the connection is cut",
        TRUNCATED: "half of the body",
        EMPTY: "an answer without a choice",
        REFUSAL: "the model refuses",
        FILTERED: "finish reason content_filter",
        NONSENSE: "an answer that is none to the question",
        CUT_OFF: "half of the answer, finish reason length",
        CUT_OFF_THINKING: "no answer, finish reason length",
        CONTENT_PARTS: "the answer as a list of parts",
        REASONING_FIELD: "the answer in the field for reasoning",
        STREAMED: "the answer as a stream of events, which nobody asked for",
        STREAM_CUT: "half of such a stream",
        BROKEN_OFF: "half of the answer, finish reason error",
        TOOL_CALL: "the answer as the argument of a tool which nobody offered",
        KEY_IN_ERROR: "status 401 that repeats the key",
        KEY_IN_REPLY: "an answer that repeats the key",
        ALL_TRUE: "every label is true, whatever is shown",
        ALL_FALSE: "every label is false, whatever is shown",
        DEAF: "the same answer, whatever is asked",
        **{name: error.summary for name, error in CANNED_ERRORS.items()},
    }
)
"""What every fault is, by its name."""


@dataclass(frozen=True)
class FaultPlan:
    """How often calls fail, and in which ways.

    Attributes:
        rate: share of calls that fail, 0 to 1.
        kinds: the ways, all equally likely.
        seed: decides which calls fail.
        retry_after: seconds that a rate limit asks to wait.
        slowness: seconds that a slow call takes longer.
        after: so many calls are answered before the first fails, in the order of arrival.

    Raises:
        ConfigurationError: if the rate is no share, or calls should fail in no way.
        UnknownNameError: if there is no such fault.
    """

    rate: float = 0.0
    kinds: tuple[str, ...] = PASSING
    seed: int = 0
    retry_after: float = 0.05
    slowness: float = 0.5
    after: int = 0

    def __post_init__(self) -> None:
        if not 0 <= self.rate <= 1:
            raise ConfigurationError(f"'faults': expected a share from 0 to 1, got {self.rate}")
        if self.rate and not self.kinds:
            raise ConfigurationError("'faults': expected at least one kind of fault, got none")
        for kind in self.kinds:
            if kind not in FAULTS:
                raise UnknownNameError("fault", kind, FAULTS)

    @classmethod
    def of_names(cls, names: Iterable[str], rate: float | None, seed: int) -> FaultPlan:
        """The plan of a command line.

        Args:
            names: of the faults; empty for those that pass.
            rate: share of failing calls; None for all where faults are named, else for none.
            seed: decides which calls fail.
        """
        kinds = tuple(dict.fromkeys(names))
        share = rate if rate is not None else float(bool(kinds))
        return cls(share, kinds or PASSING, seed)


class FaultChooser:
    """Decides which calls fail: by what is asked and how often, not by the order of arrival.

    Args:
        plan: how often and in which ways.
    """

    def __init__(self, plan: FaultPlan) -> None:
        self._plan = plan
        self._asked: Counter[str] = Counter()

    def choose(self, question: str) -> str | None:
        """The fault of the next call with a question; None for an answer.

        Args:
            question: a digest of the call's body.
        """
        self._asked[question] += 1
        if self._asked.total() <= self._plan.after:
            return None
        chance = Chance(self._plan.seed, "fault", question, self._asked[question])
        return chance.pick(self._plan.kinds) if chance.happens(self._plan.rate) else None

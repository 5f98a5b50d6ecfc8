"""What a call of a model took."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Usage:
    """What a call took.

    Attributes:
        input_tokens: tokens of prompt and pictures; None if not told.
        output_tokens: tokens of the reply, reasoning included; None if not told.
        cost: in US dollars; None if unknown, which is not zero.
        seconds: wall time of the call.
    """

    input_tokens: int | None = None
    output_tokens: int | None = None
    cost: float | None = None
    seconds: float = 0.0

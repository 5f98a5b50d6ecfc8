"""What is taken for likely before anything was read; the only constants of decoding."""

from __future__ import annotations

import math

from pydantic import BaseModel, ConfigDict, Field


class Priors(BaseModel):
    """What is believed of readings and rules beforehand, and how long is decoded."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    misread: float = Field(
        default=0.025,
        gt=0.0,
        lt=0.5,
        description="share of readings that are wrong, before anything is known; as measured of "
        "GPT-5",
        json_schema_extra={"unit": "share of the readings"},
    )
    sure: float = Field(
        default=0.9,
        gt=0.5,
        lt=1.0,
        description="what holds before so many successes of a skill is taken to be needed",
        json_schema_extra={"unit": "share of the successes"},
    )
    sweeps: int = Field(
        default=12,
        ge=1,
        description="how often messages are passed along all edges in one round, at most",
        json_schema_extra={"unit": "sweeps"},
    )
    rounds: int = Field(
        default=6,
        ge=1,
        description="rounds of estimating rules and error rates in each of three phases, at most",
        json_schema_extra={"unit": "rounds"},
    )

    @property
    def reading_odds(self) -> float:
        """What one reading is worth, in nats: no other evidence counts for more at once."""
        return math.log((1 - self.misread) / self.misread)


def rate(wrong: float, seen: float, mean: float) -> float:
    """An error rate out of counts.

    The prior is Beta with Jeffreys' shape, a half, for errors, and the mean that is given; so it
    is worth half an error, and as many observations as that takes.
    """
    return (wrong + 0.5) / (seen + 0.5 / mean)

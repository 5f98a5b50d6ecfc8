"""Settings of perception."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.perception.decoding.priors import Priors


class PerceptionSettings(BaseModel):
    """What is made of what was read in pictures."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    labels: Literal["auto", "raw", "decoded"] = Field(
        default="auto",
        description="what is learned from: labels as they were read (raw), or the likeliest states "
        "behind them (decoded); auto for what suits the learner",
    )
    decoding: Priors = Field(
        default_factory=Priors, description="what is believed of readings beforehand (D24)"
    )

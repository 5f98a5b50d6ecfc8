"""Settings of planning under doubt."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field


class HypothesesSettings(BaseModel):
    """How many hypotheses are kept, and when trying them ends."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    states: int = Field(
        default=30,
        ge=1,
        description="how many of the likeliest starts, and of the likeliest goals, are kept",
        json_schema_extra={"unit": "abstract states"},
    )
    least: float = Field(
        default=0.005,
        gt=0.0,
        lt=1.0,
        description="plans that are less likely to succeed are not tried",
        json_schema_extra={"unit": "probability"},
    )
    surprise: float = Field(
        default=0.001,
        gt=0.0,
        lt=0.5,
        description="how often a skill turns out otherwise than a right hypothesis says",
        json_schema_extra={"unit": "share of the plans"},
    )
    claim: float = Field(
        default=0.5,
        ge=0.5,
        lt=1.0,
        description="a problem is impossible only if hypotheses without a plan are likelier",
        json_schema_extra={"unit": "probability"},
    )
    look_again: bool = Field(
        default=False,
        description="whether the pictures after the skills of a plan that went wrong are read too",
    )
    starts: int = Field(
        default=15,
        ge=1,
        description="after so many resets a method that executed nothing looks around first",
        json_schema_extra={"unit": "pictures"},
    )
    reachable: int = Field(
        default=20_000,
        ge=1,
        description="up to so many states that a model leads to are told apart; in larger worlds "
        "one reading has to do",
        json_schema_extra={"unit": "abstract states"},
    )

"""How models are asked."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class AskingSettings(BaseModel):
    """How models are asked; nothing here changes what a single reply means."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    parallel: int = Field(
        default=1,
        ge=1,
        description="calls in flight at the same time; with 1 there are no threads",
        json_schema_extra={"unit": "calls"},
    )
    batch_size: int = Field(
        default=60,
        ge=1,
        description="ground atoms judged in one call, at most",
        json_schema_extra={"unit": "ground atoms"},
    )
    summarise: Literal["when-needed", "always"] = Field(
        default="when-needed",
        description="when-needed asks for a summary of a judgement only if that does not name "
        "every ground atom with one clear verdict; always is the paper's way",
    )
    reasks: int = Field(
        default=2,
        ge=0,
        description="how often ground atoms are asked for again that a reply left out",
        json_schema_extra={"unit": "questions"},
    )
    unusable_reasks: int = Field(
        default=4,
        ge=0,
        description="how often a question is asked again whose whole reply was of no use",
        json_schema_extra={"unit": "questions"},
    )
    votes: int = Field(
        default=1,
        ge=1,
        description="how often every ground atom is judged, independently",
        json_schema_extra={"unit": "votes"},
    )
    margin: float = Field(
        default=0.0,
        ge=0.0,
        le=1.0,
        description="by what share of the votes the majority must lead; a tie or a smaller lead "
        "makes the label unknown",
        json_schema_extra={"unit": "share of the votes"},
    )

    @property
    def most_repetitions(self) -> int:
        """How often one vote on one batch of ground atoms is asked for at most."""
        return 1 + self.reasks + self.unusable_reasks


class EndpointSettings(BaseModel):
    """How a model behind an endpoint is asked."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    timeout: float = Field(
        default=120.0,
        gt=0.0,
        description="how long one attempt may take",
        json_schema_extra={"unit": "seconds"},
    )
    temperature: float | None = Field(
        default=None,
        ge=0.0,
        le=2.0,
        description="none for the model's default; some models accept no other",
        json_schema_extra={"unit": "temperature"},
    )
    max_output_tokens: int | None = Field(
        default=None,
        ge=1,
        description="longest reply, reasoning included; none for the model's default",
        json_schema_extra={"unit": "tokens"},
    )
    reasoning_effort: str | None = Field(
        default=None, description="e.g. low; none for the model's default"
    )
    image_size: int | None = Field(
        default=1024,
        ge=1,
        description="pictures with a longer side are scaled down to this; none for never",
        json_schema_extra={"unit": "pixels"},
    )

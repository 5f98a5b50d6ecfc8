"""Settings of exploration."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class ExplorationSettings(BaseModel):
    """How the next skill sequence is found (paper, Section 3.1; docs/semantics.md D16)."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    explorer: str = Field(
        default="planned",
        description="who chooses what to try next: planned, by expected information; mixed, the "
        "same with proposed sequences among the candidates; paper, as published; or random",
    )
    lookahead: int = Field(
        default=15,
        ge=0,
        description="planned looks at most so many skills ahead",
        json_schema_extra={"unit": "skills"},
    )
    weighed: int = Field(
        default=40_000,
        ge=1,
        description="planned weighs at most so many attempts in one choice, a skill instance in "
        "a state each; bounds the time that it takes",
        json_schema_extra={"unit": "attempts"},
    )
    budget: int = Field(
        default=15,
        ge=1,
        description="skills executed in one iteration",
        json_schema_extra={"unit": "skills"},
    )
    reset_price: int = Field(
        default=0,
        ge=0,
        description="so many skills of the budget a further start within an iteration counts as, "
        "where nothing leads away any more; at the budget or above there is none",
        json_schema_extra={"unit": "skills"},
    )
    candidates: int = Field(
        default=5,
        ge=1,
        description="sequences asked for at once",
        json_schema_extra={"unit": "sequences"},
    )
    least_length: int = Field(
        default=15,
        ge=1,
        description="a sequence is at least so long, even if the budget is smaller",
        json_schema_extra={"unit": "skills"},
    )
    target_ratio: float = Field(
        default=0.5,
        ge=0.0,
        le=1.0,
        description="wanted share of predicted successes (the paper's r*)",
        json_schema_extra={"unit": "share of the skills"},
    )
    pairs: Literal["instances", "skills"] = Field(
        default="instances",
        description="whether coverage counts pairs of skill instances or of skills",
    )
    choice: Literal["pareto", "uniform"] = Field(
        default="pareto",
        description="which candidate paper takes: pareto, one that none beats in both scores; "
        "uniform, any (No Heuristic)",
    )
    named_pairs: int = Field(
        default=12,
        ge=0,
        description="how many least explored pairs the prompt names",
        json_schema_extra={"unit": "pairs"},
    )
    scarce_successes: int = Field(
        default=3,
        ge=0,
        description="the prompt names skills with fewer successes than this",
        json_schema_extra={"unit": "successes"},
    )

    @property
    def length(self) -> int:
        """How long a proposed sequence should be."""
        return max(self.budget, self.least_length)

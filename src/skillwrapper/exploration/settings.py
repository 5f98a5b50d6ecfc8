"""Settings of exploration."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class ExplorationSettings(BaseModel):
    """How the next skill sequence is found (paper, Section 3.1; DESIGN.md D16).

    Attributes:
        budget: skills executed in one iteration.
        candidates: sequences asked for at once.
        least_length: a sequence is at least so long, even if the budget is smaller.
        target_ratio: wanted share of predicted successes (the paper's r*).
        pairs: whether coverage counts pairs of skill instances or of skills.
        choice: ``pareto`` as in the paper; ``uniform`` takes any candidate (No Heuristic);
            ``random`` asks no model and draws skill instances (Random Exploration).
        named_pairs: how many least explored pairs the prompt names.
        scarce_successes: the prompt names skills with fewer successes than this.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    budget: int = Field(default=15, ge=1)
    candidates: int = Field(default=5, ge=1)
    least_length: int = Field(default=15, ge=1)
    target_ratio: float = Field(default=0.5, ge=0.0, le=1.0)
    pairs: Literal["instances", "skills"] = "instances"
    choice: Literal["pareto", "uniform", "random"] = "pareto"
    named_pairs: int = Field(default=12, ge=0)
    scarce_successes: int = Field(default=3, ge=0)

    @property
    def length(self) -> int:
        """How long a proposed sequence should be."""
        return max(self.budget, self.least_length)

"""Settings of the learner."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class LearningSettings(BaseModel):
    """How predicates are invented, scored and pruned.

    Attributes:
        threshold: least score of a candidate predicate (the paper's h; 0.6 for its simulated
            kitchen, 0.5 for its robots).
        attempts: how often the model is asked for one inconsistency (D8).
        candidates: how many candidates are asked for at once; the best is kept (D6).
        max_inventions: upper bound on questions in one iteration.
        prune: whether superfluous predicates are set dormant (D9).
        absences: whether preconditions may be universal absences (D2).
        invention: ``pairs`` asks for one predicate at a time, from what disagrees with the model;
            ``batch`` asks for all of them once, after the first iteration (FM Invent).
        batch_size: how many predicates ``batch`` asks for at most.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    threshold: float = Field(default=0.6, ge=0.0, le=1.0)
    attempts: int = Field(default=3, ge=1)
    candidates: int = Field(default=5, ge=1)
    max_inventions: int = Field(default=60, ge=0)
    prune: bool = True
    absences: bool = True
    invention: Literal["pairs", "batch"] = "pairs"
    batch_size: int = Field(default=20, ge=1)

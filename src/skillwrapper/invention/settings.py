"""Settings of learning with invention: a run's ``learning``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from skillwrapper.learning.settings import LearnerSettings


class LearningSettings(LearnerSettings):
    """How predicates are invented, scored and pruned, and how operators are learned."""

    threshold: float = Field(
        default=0.6,
        ge=0.0,
        le=1.0,
        description="least score of a candidate predicate (the paper's h; 0.6 for its simulated "
        "kitchen, 0.5 for its robots)",
        json_schema_extra={"unit": "share of the transitions"},
    )
    attempts: int = Field(
        default=3,
        ge=1,
        description="how often the model is asked for one inconsistency (D8)",
        json_schema_extra={"unit": "questions"},
    )
    candidates: int = Field(
        default=5,
        ge=1,
        description="how many candidates are asked for at once; the best is kept (D6)",
        json_schema_extra={"unit": "predicates"},
    )
    max_inventions: int = Field(
        default=60,
        ge=0,
        description="upper bound on questions for predicates in one iteration",
        json_schema_extra={"unit": "questions"},
    )
    prune: bool = Field(
        default=True, description="whether superfluous predicates are set dormant (D9)"
    )
    invention: Literal["pairs", "batch"] = Field(
        default="pairs",
        description="pairs asks for one predicate at a time, from what disagrees with the model; "
        "batch asks for all of them once, after the first iteration (FM Invent)",
    )
    batch_size: int = Field(
        default=20,
        ge=1,
        description="how many predicates batch asks for at most",
        json_schema_extra={"unit": "predicates"},
    )

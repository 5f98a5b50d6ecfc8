"""Settings of learners."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field


class LearnerSettings(BaseModel):
    """Who learns operators, and what these may say."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    learner: str = Field(
        default="faithful", description="who learns operators from labelled transitions"
    )
    absences: bool = Field(
        default=True, description="whether preconditions may be universal absences (D2)"
    )
    context_of_one: int = Field(
        default=3,
        ge=0,
        description="how many objects that are no arguments the effect of an operator may have "
        "that is learned from a single transition (D23)",
        json_schema_extra={"unit": "objects"},
    )
    existential_context: int = Field(
        default=4,
        ge=0,
        description="how many objects an operator may ask for of which only its conditions speak "
        "(D2)",
        json_schema_extra={"unit": "objects"},
    )
    least_confidence: float = Field(
        default=0.9,
        ge=0.5,
        le=1.0,
        description="labels with less confidence count as unknown (D10, D24)",
        json_schema_extra={"unit": "probability"},
    )
    operator_cost: float = Field(
        default=0.5,
        ge=0.0,
        description="transitions that an operator has to account for to be worth having",
        json_schema_extra={"unit": "transitions"},
    )

"""What learned action models may say."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class ActionModelSettings(BaseModel):
    """How action models are learned from traces (docs/semantics.md D23)."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    negatives: Literal["none", "reasoned", "declared", "all"] = Field(
        default="declared",
        description="which negative preconditions, and which inequalities of arguments, of those "
        "that were never violated: none; reasoned, what explains a failure that nothing positive "
        "explains; declared, moreover what the domain's requirements announce "
        "(:negative-preconditions, :equality); all",
    )
    enough_failures: int = Field(
        default=3,
        ge=1,
        description="a precondition that was violated in so many different failures, and never "
        "explained one alone, is given up if it follows from others in all states that were kept",
        json_schema_extra={"unit": "views"},
    )
    witness_states: int = Field(
        default=500,
        ge=0,
        description="how many states are kept to see whether a precondition makes a difference",
        json_schema_extra={"unit": "states"},
    )
    effects: Literal["conditional", "separate"] = Field(
        default="conditional",
        description="how it is printed that what an action does depends on context: conditional, "
        "as one action with (when ...); separate, as several actions without, of which one applies",
    )
    cautious: bool = Field(
        default=False,
        description="whether of what no state before an action shows anything, where states are "
        "missing, everything counts as its precondition; what is learned is sound then, and may "
        "never apply. Otherwise a precondition was seen to hold at least once",
    )

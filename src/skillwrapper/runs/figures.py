"""The figures of a run, as commands print them and files keep them."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Count = Annotated[int, Field(ge=0, le=2**53)]


class RunFigures(BaseModel):
    """What a run has done and learned, in numbers.

    ``episodes`` is missing where every iteration was one. ``evaluation_calls`` are the calls that
    reading the pictures took, ``..._reasking`` those that it would take to ask every predicate on
    every picture after each invention.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    iterations: Count
    episodes: Count | None = None
    converged: bool
    executions: Count
    predicates: Count
    operators: Count
    lemma1_violations: Count
    theorem1_violations: Count
    undecided: Count
    inconsistencies: Count
    inconsistencies_by_kind: dict[str, Count]
    unresolved: Count
    evaluation_calls: Count
    evaluation_calls_reasking: Count

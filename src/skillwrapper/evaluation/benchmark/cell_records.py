"""What the files of a cell hold, as types: whatever is read from them has passed through these."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, RootModel

from skillwrapper.evaluation.exact.learning_curves import CurvePoint
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.runs.provenance import Provenance

Share = Annotated[float, Field(ge=0.0, le=1.0)]
Amount = Annotated[float, Field(ge=0.0, le=1e15)]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, strict=True, allow_inf_nan=False)


class VocabularyRecord(_Record):
    """How many of the facts that vary the vocabulary determines."""

    share: Share | None


class ExactRecord(_Record):
    """The exact figures of a model; further ones are of no use to tables."""

    precision: Share | None
    recall: Share | None
    effect_accuracy: Share | None
    sound: bool | None
    complete: bool | None
    suitable: bool | None
    vocabulary: VocabularyRecord | None
    predicates: Amount
    operators: Amount


class EfficiencyRecord(_Record):
    """What executions were worth."""

    curve: tuple[CurvePoint, ...]
    area: Share | None
    changing: Share
    pairs_covered: Share


class CostsRecord(_Record):
    """What model calls took."""

    calls: Amount
    cost: Amount | None
    input_tokens: Amount | None
    output_tokens: Amount | None
    seconds: Amount | None


class CellRecord(_Record):
    """``result.json``."""

    model_config = ConfigDict(extra="forbid")

    cell: Cell
    problems: tuple[ProblemResult, ...]
    exact: ExactRecord | None
    learning: dict[str, bool | Amount | dict[str, Amount] | None]
    efficiency: EfficiencyRecord | None
    seconds: Amount
    costs: dict[str, CostsRecord | None]


class ProblemLine(RootModel[ProblemResult]):
    """A line of ``problems.jsonl``."""


class RunLine(_Record):
    """A line of ``runs.jsonl``: a command that ran cells, with versions and commit."""

    command: str
    made_with: Provenance

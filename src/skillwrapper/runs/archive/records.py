"""What the files of a run hold, as types: whatever is read from them has passed through these."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, RootModel

from skillwrapper.runs.figures import RunFigures

FORMAT = 1
"""Of the whole folder; a reader of another format says so instead of guessing."""

Count = Annotated[int, Field(ge=0, le=2**53)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]
Sha256 = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


class Record(BaseModel):
    """What one file, or one line of a file, holds."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class PictureRecord(Record):
    """A picture of an observation; the file in ``images/`` is named by its content."""

    camera: str
    sha256: Sha256


class SceneRecord(Record):
    """A scene: its name and the names of its objects."""

    name: str
    objects: tuple[str, ...]


class EpisodeRecord(Record):
    """The first line of an episode: where it started.

    A *given* episode is taken as it is: it was imported or executed for a goal, or a person ended
    it. What else is recorded was chosen by the run, and is compared with what it chooses again.
    """

    scene: SceneRecord
    seed: int
    start: tuple[PictureRecord, ...] = Field(min_length=1)
    given: bool | None = None


class ExecutionRecord(Record):
    """Every further line of an episode: a skill, and what came of it.

    ``before`` is there if the skill started from other pictures than the line above ended with.
    """

    skill: str
    arguments: tuple[str, ...]
    success: bool
    message: str
    before: tuple[PictureRecord, ...] | None = Field(default=None, min_length=1)
    after: tuple[PictureRecord, ...] = Field(min_length=1)
    changed: bool | None = None


class WitnessRecord(Record):
    """A transition that an inconsistency speaks of."""

    transition: Count
    instance: str
    success: bool
    before: tuple[Sha256, ...]
    after: tuple[Sha256, ...]


class InconsistencyRecord(Record):
    """An inconsistency with its transitions and pictures."""

    kind: str
    skill: str
    witnesses: tuple[WitnessRecord, ...]
    unexplained: tuple[str, ...]


class DecisionRecord(Record):
    """What was decided of a predicate, and why."""

    verdict: str
    predicate: str
    semantics: str = ""
    score: float | None = None
    reason: str
    inconsistency: InconsistencyRecord | None = None

    @property
    def name(self) -> str:
        """The name of the predicate, without its parameters."""
        return self.predicate.partition("(")[0]


class ViolationRecord(Record):
    """A transition that breaks a statement of the certificate."""

    statement: str
    skill: str
    transition: Count
    partner: Count | None
    reason: str


class LeftOutRecord(Record):
    """A success of which no operator was learned."""

    skill: str
    transition: Count
    reason: str


class CertificateRecord(Record):
    """Lemma 1 and Theorem 1 on the recorded data."""

    transitions: Count
    decided: Count
    undecided: Count
    no_ops: Count
    violations: tuple[ViolationRecord, ...]
    lemma1_violations: Count
    theorem1_violations: Count
    left_out: tuple[LeftOutRecord, ...] = ()
    explained: Share | None = None


class OverruledRecord(Record):
    """A reading that is taken for a mistake."""

    scene: str
    pictures: tuple[Sha256, ...]
    atom: str
    read: bool
    posterior: Share


class ErrorRatesRecord(Record):
    """How often a predicate is misread, as estimated without the truth."""

    predicate: str
    false_positive: Share
    false_negative: Share
    negatives: float = Field(ge=0.0)
    positives: float = Field(ge=0.0)


class DecodingRecord(Record):
    """What decoding made of the readings."""

    readings: Count
    in_doubt: Count
    dirty: Share
    rates: tuple[ErrorRatesRecord, ...]
    overruled: tuple[OverruledRecord, ...]

    def rates_of(self, predicate: str) -> ErrorRatesRecord | None:
        """Those of a predicate, by its name."""
        return next((found for found in self.rates if found.predicate == predicate), None)


class SummaryRecord(RunFigures):
    """Figures at the end of an iteration.

    Attributes:
        pairs_covered: share of the pairs of skill instances that were tried.
        untested: for every operator the conditions that nothing has put to the test.
        needed: for every operator how likely each of its conditions is needed.
        agreement: for every predicate that was voted on the share of votes for the label.
    """

    pairs_covered: Share
    untested: dict[str, tuple[str, ...]]
    needed: dict[str, dict[str, Share]] = Field(default_factory=dict)
    agreement: dict[str, Share]


class EventRecord(BaseModel):
    """A line of the log: when, what, in which iteration, and whatever describes it."""

    model_config = ConfigDict(extra="allow", frozen=True, strict=True, allow_inf_nan=False)

    # The year 9999: what comes later is no time that calendars can tell.
    time: float = Field(ge=0.0, le=253_402_300_799.0)
    event: str
    iteration: Count


class CurvePointRecord(Record):
    """Exact figures of the model after so many executions; a figure may be missing."""

    executions: Count
    precision: Share | None = None
    recall: Share | None = None
    effect_accuracy: Share | None = None
    predicates: Count | None = None
    operators: Count | None = None


class LabelCorrection(Record):
    """A person says what is true in a picture, or that nobody can tell (None).

    ``read`` is what stood there before.
    """

    kind: Literal["label"] = "label"
    observation: Sha256
    atom: str = Field(min_length=1)
    value: bool | None
    read: bool | None


class Renaming(Record):
    """A person gives a predicate another name; types and meaning are what it has now."""

    kind: Literal["rename"] = "rename"
    predicate: str = Field(min_length=1)
    to: str = Field(min_length=1)
    types: tuple[str, ...]
    semantics: str


class Rewording(Record):
    """A person says otherwise what a predicate means; the types are what it has now."""

    kind: Literal["reword"] = "reword"
    predicate: str = Field(min_length=1)
    types: tuple[str, ...]
    semantics: str = Field(min_length=1)


class Rejection(Record):
    """A person does not want a predicate."""

    kind: Literal["reject"] = "reject"
    predicate: str = Field(min_length=1)


class CorrectionRecord(
    RootModel[
        Annotated[LabelCorrection | Renaming | Rewording | Rejection, Field(discriminator="kind")]
    ]
):
    """A line of ``corrections.jsonl``."""


class DecisionsFile(RootModel[tuple[DecisionRecord, ...]]):
    """``decisions.json``."""


class UnresolvedFile(RootModel[tuple[InconsistencyRecord, ...]]):
    """``unresolved.json``."""


class CurveFile(RootModel[tuple[CurvePointRecord, ...]]):
    """``curve.json``."""


def to_plain(record: BaseModel) -> Any:
    """A record as plain data."""
    return record.model_dump(mode="json")

"""Learning curves: how true the model is after how many executions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.evaluation.exact.predictions import predict_all
from skillwrapper.evaluation.exact.tallies import Tally, tally_by_skill
from skillwrapper.grounding import GroundModel
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.records import CurvePointRecord
from skillwrapper.symbols import AbstractModel


@dataclass(frozen=True)
class Stage:
    """A model on the way of learning.

    Attributes:
        executions: skills executed until then.
        model: what was learned from them.
    """

    executions: int
    model: AbstractModel


@dataclass(frozen=True)
class CurvePoint:
    """The exact figures of a model on the way of learning; None for what is undefined.

    Attributes:
        executions: skills executed until then.
        precision: as in ``tallies.Tally``.
        recall: likewise.
        effect_accuracy: likewise.
        predicates: number of predicates.
        operators: number of operators.
    """

    executions: int
    precision: float | None
    recall: float | None
    effect_accuracy: float | None
    predicates: int
    operators: int


def read_stages(archive: RunArchive) -> tuple[Stage, ...]:
    """The model after every finished iteration of a run.

    Raises:
        UserError: if a file is damaged.
    """
    return tuple(Stage(i.summary.executions, i.model) for i in archive.iterations())


def learning_curve(
    stages: Sequence[Stage], scenes: Sequence[LabelledStates]
) -> tuple[CurvePoint, ...]:
    """Exact figures of every stage.

    Args:
        stages: the models, in order of time.
        scenes: the states of at least one scene with their labels.
    """
    return tuple(_point(stage, scenes) for stage in stages)


def area_under(points: Sequence[tuple[int, float | None]]) -> float | None:
    """Area under a rising staircase over executions, divided by all executions.

    Returns:
        None without executions, or if a value is undefined.
    """
    area, height, position = 0.0, 0.0, 0
    for executions, value in points:
        if value is None:
            return None
        area += height * (executions - position)
        position, height = executions, value
    return area / position if position else None


def write_curve(archive: RunArchive, curve: Sequence[CurvePoint]) -> None:
    """Keep a curve in the folder of its run, where reports find it."""
    archive.write_curve([CurvePointRecord(**vars(point)) for point in curve])


def _point(stage: Stage, scenes: Sequence[LabelledStates]) -> CurvePoint:
    total = sum((_tally(stage.model, labelled) for labelled in scenes), Tally())
    return CurvePoint(
        executions=stage.executions,
        precision=total.precision,
        recall=total.recall,
        effect_accuracy=total.effect_accuracy,
        predicates=len(stage.model.predicates),
        operators=len(stage.model.operators),
    )


def _tally(model: AbstractModel, labelled: LabelledStates) -> Tally:
    ground = GroundModel.of(model, labelled.states.scene.objects)
    found = predict_all(ground, labelled.states.space, labelled.labels(ground.space))
    return sum(tally_by_skill(found).values(), Tally())

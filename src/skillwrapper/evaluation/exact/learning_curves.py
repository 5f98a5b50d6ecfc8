"""Learning curves: how true the model is after how many executions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from skillwrapper.evaluation.exact.predictions import predict_all
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
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
    """The exact figures of a model on the way of learning.

    Attributes:
        executions: skills executed until then.
        precision: as in ``verification.Verification``.
        recall: likewise.
        effect_accuracy: likewise.
        predicates: number of predicates.
        operators: number of operators.
    """

    executions: int
    precision: float
    recall: float
    effect_accuracy: float
    predicates: int
    operators: int


def read_stages(archive: RunArchive) -> tuple[Stage, ...]:
    """The model after every finished iteration of a run.

    Raises:
        UserError: if a file is damaged.
    """
    return tuple(Stage(i.summary.executions, i.model) for i in archive.iterations())


def learning_curve(
    stages: Sequence[Stage], space: StateSpace, label_all: Callable[[AtomSpace], Labels]
) -> tuple[CurvePoint, ...]:
    """Exact figures of every stage.

    Args:
        stages: the models, in order of time.
        space: the true state space.
        label_all: labels of all its states (states, atoms).
    """
    return tuple(_point(stage, space, label_all) for stage in stages)


def area_under(points: Sequence[tuple[int, float]]) -> float:
    """Area under a rising staircase over executions, divided by all executions; 0 without any."""
    area, height, position = 0.0, 0.0, 0
    for executions, value in points:
        area += height * (executions - position)
        position, height = executions, value
    return area / position if position else 0.0


def write_curve(archive: RunArchive, curve: Sequence[CurvePoint]) -> None:
    """Keep a curve in the folder of its run, where reports find it."""
    archive.write_curve([CurvePointRecord(**vars(point)) for point in curve])


def _point(stage: Stage, space: StateSpace, label_all: Callable[[AtomSpace], Labels]) -> CurvePoint:
    ground = GroundModel.of(stage.model, stage.model.domain.objects)
    found = predict_all(ground, space, label_all(ground.space))
    hits = int((found.applicable & space.success).sum())
    return CurvePoint(
        executions=stage.executions,
        precision=_ratio(hits, int(found.applicable.sum())),
        recall=_ratio(hits, int(space.success.sum())),
        effect_accuracy=_ratio(int(found.effects_right.sum()), int(found.effects_made.sum())),
        predicates=len(stage.model.predicates),
        operators=len(stage.model.operators),
    )


def _ratio(part: int, whole: int) -> float:
    return part / whole if whole else 1.0

"""Learning curves: how true the model is after how many executions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from skillwrapper.evaluation.exact.predictions import predict_all
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.files.writing import write_json
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.recorder import read_episode
from skillwrapper.symbols import AbstractModel
from skillwrapper.symbols.files import read_model
from skillwrapper.world.domain import Domain

EXACT_CURVE: Final = "curve.json"
"""Optional, in the folder of a run: its learning curve, a list of ``CurvePoint`` as objects."""


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


def read_stages(folder: RunFolder, domain: Domain) -> tuple[Stage, ...]:
    """The model after every finished iteration of a run.

    Raises:
        RunFolderError: if a file is damaged.
    """
    executions, stages = 0, []
    for number in range(1, folder.finished_iterations() + 1):
        executions += len(read_episode(folder, number).transitions)
        model = read_model(folder.iteration(number) / "model.json", domain)
        stages.append(Stage(executions, model))
    return tuple(stages)


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


def write_curve(folder: RunFolder, curve: Sequence[CurvePoint]) -> Path:
    """Keep a curve in the folder of its run, where reports find it; returns the file."""
    path = folder.path / EXACT_CURVE
    write_json(path, [vars(point) for point in curve])
    return path


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

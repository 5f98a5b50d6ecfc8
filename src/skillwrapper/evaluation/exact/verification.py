"""Exact verification: a model against every state and every skill instance of its domain."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillwrapper.errors import InternalError
from skillwrapper.evaluation.exact.predictions import Predictions, predict_all
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.evaluation.exact.verdicts import Verdicts, Violation, judge
from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.world.capabilities import Enumerable, look_at
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance

Labeller = Callable[[Sequence[Observation]], Labels]
"""Reads pictures: a row over the ground atoms for every observation (observations, atoms)."""


@dataclass(frozen=True)
class Counterexample:
    """A shortest way to see that a definition does not hold.

    Attributes:
        verdict: the definition: ``"sound"``, ``"complete"`` or ``"suitable"``.
        reason: what is wrong.
        path: skill instances from the standard start to the state in question.
        instance: the skill instance that is predicted wrongly there.
        difference: atoms that are predicted otherwise than they are read.
        before: what is seen in the state.
        after: what is seen after running the instance.
    """

    verdict: str
    reason: str
    path: tuple[SkillInstance, ...]
    instance: SkillInstance
    difference: tuple[str, ...]
    before: Observation
    after: Observation

    def to_json(self) -> dict[str, Any]:
        """Plain data, pictures by their keys."""
        return {
            "verdict": self.verdict,
            "reason": self.reason,
            "path": [str(instance) for instance in self.path],
            "instance": str(self.instance),
            "difference": list(self.difference),
            "before": self.before.key,
            "after": self.after.key,
        }

    def save_pictures(self, folder: Path) -> tuple[Path, ...]:
        """Write the pictures before and after, as ``<verdict>-before-<camera>.png``, ..."""
        folder.mkdir(parents=True, exist_ok=True)
        written = []
        for moment, observation in (("before", self.before), ("after", self.after)):
            for picture in observation.pictures:
                path = folder / f"{self.verdict}-{moment}-{picture.camera}.png"
                path.write_bytes(picture.png)
                written.append(path)
        return tuple(written)


@dataclass(frozen=True)
class Verification:
    """The truth about a model. Ratios of nothing, e.g. the precision of no prediction, are 1.

    Attributes:
        states: number of reachable states.
        pairs: number of states times skill instances.
        successes: number of pairs in which the skill truly succeeds.
        undecided: pairs whose prediction rests on an atom that was read as unknown.
        precision: of the pairs predicted to succeed, the share that does.
        recall: of the pairs that succeed, the share predicted to.
        effect_accuracy: of the changes predicted for successes by applicable ground operators,
            the share that is exactly what is read afterwards.
        precision_by_skill: precision of every skill.
        recall_by_skill: recall of every skill.
        effect_accuracy_by_skill: effect accuracy of every skill.
        sound: whether the model is sound (the paper's definition).
        complete: whether it is complete; None if that could not be decided.
        suitable: whether it is suitable.
        counterexamples: one for each definition that does not hold.
        seconds: wall-clock time.
    """

    states: int
    pairs: int
    successes: int
    undecided: int
    precision: float
    recall: float
    effect_accuracy: float
    precision_by_skill: dict[str, float]
    recall_by_skill: dict[str, float]
    effect_accuracy_by_skill: dict[str, float]
    sound: bool
    complete: bool | None
    suitable: bool
    counterexamples: tuple[Counterexample, ...]
    seconds: float

    def to_json(self) -> dict[str, Any]:
        """Plain data with the attributes as keys."""
        plain = {name: value for name, value in vars(self).items() if name != "counterexamples"}
        return {**plain, "counterexamples": [c.to_json() for c in self.counterexamples]}


def verify(
    environment: Enumerable, model: AbstractModel, labeller: Labeller, *, seed: int = 0
) -> Verification:
    """Render every reachable state, read it, and compare predictions with what happens.

    Args:
        environment: a domain that can list its states.
        model: the model to check.
        labeller: reads the pictures, over the atoms of the model's predicates and the scene.
        seed: chooses the layout of the pictures.
    """
    started = time.monotonic()
    environment.reset(seed=seed)
    space = StateSpace.of(environment)
    labels = labeller(look_at(environment, space.states))
    found = verify_labels(environment, space, model, labels)
    return replace(found, seconds=time.monotonic() - started)


def verify_labels(
    environment: Enumerable, space: StateSpace, model: AbstractModel, labels: Labels
) -> Verification:
    """The same with labels that are known already.

    Args:
        environment: the domain; draws the counterexamples in its present layout.
        space: its whole state space.
        model: the model to check.
        labels: the abstract state of every state (states, atoms).
    """
    started = time.monotonic()
    objects = environment.scene.objects
    ground = GroundModel.of(model, objects)
    if labels.shape != (len(space.states), len(ground.space.atoms)):
        raise InternalError(
            f"expected labels of shape {(len(space.states), len(ground.space.atoms))}, "
            f"got {labels.shape}; please report it"
        )
    predictions = predict_all(ground, space, labels)
    verdicts = judge(ground, predictions)
    return _summary(predictions, verdicts, environment, started)


def _summary(
    predictions: Predictions,
    verdicts: Verdicts,
    environment: Enumerable,
    started: float,
) -> Verification:
    space = predictions.space
    success, hits = space.success, space.success & predictions.applicable
    skills = np.array([instance.skill for instance in space.instances])
    by_skill = {name: skills == name for name in dict.fromkeys(skills.tolist())}
    made, right = predictions.effects_made, predictions.effects_right
    return Verification(
        states=len(space.states),
        pairs=int(success.size),
        successes=int(success.sum()),
        undecided=int(predictions.undecided.sum()),
        precision=_ratio(hits, predictions.applicable),
        recall=_ratio(hits, success),
        effect_accuracy=_ratio(right, made),
        precision_by_skill={
            name: _ratio(hits[:, of], predictions.applicable[:, of])
            for name, of in by_skill.items()
        },
        recall_by_skill={
            name: _ratio(hits[:, of], success[:, of]) for name, of in by_skill.items()
        },
        effect_accuracy_by_skill={
            name: _ratio(right[of], made[of]) for name, of in by_skill.items()
        },
        sound=verdicts.sound,
        complete=verdicts.complete,
        suitable=verdicts.suitable,
        counterexamples=tuple(
            _counterexample(space, violation, environment) for violation in verdicts.violations
        ),
        seconds=time.monotonic() - started,
    )


def _ratio(part: NDArray[Any], whole: NDArray[Any]) -> float:
    total = int(whole.sum())
    return int(part.sum()) / total if total else 1.0


def _counterexample(
    space: StateSpace, violation: Violation, environment: Enumerable
) -> Counterexample:
    following = int(space.following[violation.state, violation.instance])
    states = space.states[violation.state], space.states[following]
    before, after = look_at(environment, states)
    return Counterexample(
        verdict=violation.verdict,
        reason=violation.reason,
        path=space.path_to(violation.state),
        instance=space.instances[violation.instance],
        difference=violation.difference,
        before=before,
        after=after,
    )

"""What a model predicts in every state of a state space, beside what really happens."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.grounding import UNKNOWN, GroundModel, Labels
from skillwrapper.symbols import Operator

Pairs = NDArray[np.bool_]
"""A value for every state and skill instance (states, instances)."""


@dataclass(frozen=True)
class WrongEffects:
    """Successes of which an applicable binding of an operator predicts another change.

    Attributes:
        operator: the operator.
        instances: indices of the skill instances (n,).
        states: indices of the states before (n,).
        predicted: the abstract states that it predicts (n, atoms).
    """

    operator: Operator
    instances: NDArray[np.intp]
    states: NDArray[np.intp]
    predicted: Labels


@dataclass(frozen=True)
class Predictions:
    """A model's predictions over a state space.

    Attributes:
        space: the true state space.
        labels: the abstract state of every state (states, atoms).
        applicable: some operator of the instance surely applies in some binding.
        undecided: none surely applies, but with other labels for unknown atoms one might.
        reproduced: some of these predicts what really happens.
        effects_made: for every instance, number of predicted changes of successes (instances,).
        effects_right: how many of them are what really happens (instances,).
        wrong_effects: those that are not.
    """

    space: StateSpace
    labels: Labels
    applicable: Pairs
    undecided: Pairs
    reproduced: Pairs
    effects_made: NDArray[np.intp]
    effects_right: NDArray[np.intp]
    wrong_effects: tuple[WrongEffects, ...]

    @property
    def false_alarms(self) -> Pairs:
        """Predicted to succeed, but fails."""
        return self.applicable & ~self.space.success

    @property
    def missed(self) -> Pairs:
        """Succeeds, but not predicted to."""
        return self.space.success & ~self.applicable


def predict_all(model: GroundModel, space: StateSpace, labels: Labels) -> Predictions:
    """Apply every operator in every binding to every state.

    Args:
        model: the operators over the objects of the scene.
        space: the true state space.
        labels: the abstract state of every state (states, atoms).
    """
    shape = space.success.shape
    applicable, possible, reproduced = (np.zeros(shape, dtype=np.bool_) for _ in range(3))
    made, right = (np.zeros(len(space.instances), dtype=np.intp) for _ in range(2))
    wrong: list[WrongEffects] = []
    for numbers in _by_skill(space):
        for bindings in model.bind(labels, [space.instances[n] for n in numbers]):
            instance = numbers[bindings.which]
            unknown = bindings.applicability == UNKNOWN
            possible[bindings.rows[unknown], instance[unknown]] = True
            sure = bindings.sure
            rows, instance = sure.rows, numbers[sure.which]
            applicable[rows, instance] = True
            succeeds = space.success[rows, instance]
            sure, rows, instance = sure.select(succeeds), rows[succeeds], instance[succeeds]
            predicted = sure.successors()
            agrees = (predicted == labels[space.following[rows, instance]]).all(axis=1)
            reproduced[rows[agrees], instance[agrees]] = True
            np.add.at(made, instance, 1)
            np.add.at(right, instance[agrees], 1)
            if not agrees.all():
                operator, off = bindings.operator.operator, ~agrees
                wrong.append(WrongEffects(operator, instance[off], rows[off], predicted[off]))
    undecided = possible & ~applicable
    return Predictions(space, labels, applicable, undecided, reproduced, made, right, tuple(wrong))


def applicable_instances(model: GroundModel, space: StateSpace, labels: Labels) -> Pairs:
    """Which instances surely apply in some abstract states (states, instances)."""
    found = np.zeros((len(labels), len(space.instances)), dtype=np.bool_)
    for numbers in _by_skill(space):
        for bindings in model.bind(labels, [space.instances[n] for n in numbers]):
            sure = bindings.sure
            found[sure.rows, numbers[sure.which]] = True
    return found


def _by_skill(space: StateSpace) -> Iterator[NDArray[np.intp]]:
    """Indices of the instances of each skill."""
    names = [instance.skill for instance in space.instances]
    for name in dict.fromkeys(names):
        yield np.array([n for n, other in enumerate(names) if other == name], dtype=np.intp)

"""What a model predicts in every state of a state space, beside what really happens."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.grounding.ground import TRUE, UNKNOWN, GroundModel, GroundOperator, Labels

Pairs = NDArray[np.bool_]
"""A value for every state and skill instance (states, instances)."""


@dataclass(frozen=True)
class WrongEffects:
    """Successes of which an applicable ground operator predicts another change.

    Attributes:
        operator: the ground operator.
        instance: index of its skill instance.
        states: indices of the states before (n,).
        predicted: the abstract states that it predicts (n, atoms).
    """

    operator: GroundOperator
    instance: int
    states: NDArray[np.intp]
    predicted: Labels


@dataclass(frozen=True)
class Predictions:
    """A model's predictions over a state space.

    Attributes:
        space: the true state space.
        labels: the abstract state of every state (states, atoms).
        applicable: some ground operator of the instance surely applies.
        undecided: none surely applies, but with other labels for unknown atoms one might.
        reproduced: some applicable ground operator of the instance predicts what really happens.
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
    """Apply every ground operator to every state.

    Args:
        model: the ground operators.
        space: the true state space.
        labels: the abstract state of every state (states, atoms).
    """
    shape = space.success.shape
    applicable, possible, reproduced = (np.zeros(shape, dtype=np.bool_) for _ in range(3))
    made, right = (np.zeros(len(space.instances), dtype=np.intp) for _ in range(2))
    wrong: list[WrongEffects] = []
    for number, instance in enumerate(space.instances):
        truly_after = labels[space.following[:, number]]
        for operator in model.operators.get(instance, ()):
            applicability = operator.applicability(labels)
            applicable[:, number] |= applicability == TRUE
            possible[:, number] |= applicability == UNKNOWN
            states = np.flatnonzero((applicability == TRUE) & space.success[:, number])
            predicted = operator.apply(labels[states])
            agrees = (predicted == truly_after[states]).all(axis=1)
            reproduced[states[agrees], number] = True
            made[number] += len(states)
            right[number] += agrees.sum()
            if not agrees.all():
                wrong.append(WrongEffects(operator, number, states[~agrees], predicted[~agrees]))
    undecided = possible & ~applicable
    return Predictions(space, labels, applicable, undecided, reproduced, made, right, tuple(wrong))


def applicable_instances(model: GroundModel, space: StateSpace, labels: Labels) -> Pairs:
    """Which instances surely apply in some abstract states (states, instances)."""
    found = np.zeros((len(labels), len(space.instances)), dtype=np.bool_)
    for number, instance in enumerate(space.instances):
        for operator in model.operators.get(instance, ()):
            found[:, number] |= operator.applicability(labels) == TRUE
    return found

"""Balance: how close the predicted share of successes is to the wanted one (paper, Algorithm 4)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.world.skills import SkillInstance


def balance(
    model: GroundModel, start: Labels, sequence: Sequence[SkillInstance], target: float
) -> float:
    """``-|r - r*|``, the larger the better; r is the share of skills predicted to succeed.

    Args:
        model: the learned operators.
        start: abstract state (atoms,) in which the sequence starts.
        sequence: skill instances, not empty.
        target: the wanted share (the paper's r*).
    """
    return -abs(predicted_success_ratio(model, start, sequence) - target)


def predicted_success_ratio(
    model: GroundModel, start: Labels, sequence: Sequence[SkillInstance]
) -> float:
    """Share of the skills that the model predicts to succeed; a failure changes nothing."""
    state, successes = start, 0
    for instance in sequence:
        applicable = model.applicable(instance, state)
        if applicable:
            successes += 1
            state = applicable[0].apply(state[np.newaxis])[0]
    return successes / len(sequence)

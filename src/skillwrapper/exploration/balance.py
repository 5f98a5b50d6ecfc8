"""Balance: how close the predicted share of successes is to the wanted one (paper, Algorithm 4)."""

from __future__ import annotations

from collections.abc import Sequence

from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.grounding.simulation import simulate
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
    return float(simulate(model, start, sequence).succeeds.mean())

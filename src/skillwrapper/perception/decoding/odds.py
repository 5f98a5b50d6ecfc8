"""Probabilities and log-odds."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

CERTAIN = 30.0
"""Log-odds that are as good as certain."""


def to_probability(odds: Floats) -> Floats:
    """The probability of log-odds."""
    probability: Floats = 1.0 / (1.0 + np.exp(-np.clip(odds, -CERTAIN, CERTAIN)))
    return probability


def to_log_odds(probability: Floats) -> Floats:
    """The log-odds of probabilities, 0 to 1."""
    tiny = np.exp(-CERTAIN)
    odds: Floats = np.log(probability + tiny) - np.log(1.0 - probability + tiny)
    return odds

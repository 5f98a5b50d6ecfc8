"""The robust learner: takes labels for what they are worth (D24)."""

from __future__ import annotations

from skillwrapper.learning.faithful import FaithfulLearner


class RobustLearner(FaithfulLearner):
    """As the faithful one."""

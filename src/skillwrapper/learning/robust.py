"""The robust learner: takes labels for what they are worth (D24)."""

from __future__ import annotations

from skillwrapper.learning.faithful import FaithfulLearner


class RobustLearner(FaithfulLearner):
    """Learns as the faithful one does, from labels that were decoded for it.

    Runs decode labels for it by default (``perception.labels``); what is in doubt after that counts
    as unknown. So with labels without errors both learn the same.
    """

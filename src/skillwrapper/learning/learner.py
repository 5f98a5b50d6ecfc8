"""Learners: from labelled transitions to operators, chosen by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from skillwrapper.errors import UnknownNameError
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.settings import LearningSettings
from skillwrapper.transitions.labelled import LabelledTransitions


class Learner(Protocol):
    """Learns operators from labelled transitions; sees no picture and asks no model."""

    def learn(self, transitions: LabelledTransitions) -> Fit:
        """The operators of all skills, and what they leave inconsistent.

        Equal transitions give equal operators, whatever was learned before.
        """
        ...


LEARNERS: Mapping[str, Callable[[LearningSettings], Learner]] = {"faithful": FaithfulLearner}
"""The learners by their names in ``learning.learner``."""


def make_learner(settings: LearningSettings) -> Learner:
    """The learner that the settings name.

    Raises:
        UnknownNameError: if there is none of this name.
    """
    if settings.learner not in LEARNERS:
        raise UnknownNameError("learner", settings.learner, LEARNERS)
    return LEARNERS[settings.learner](settings)

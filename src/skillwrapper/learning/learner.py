"""Learners: from labelled transitions to operators, chosen by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from skillwrapper.errors import UnknownNameError
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.robust import RobustLearner
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.labelled import LabelledTransitions


class Learner(Protocol):
    """Learns operators from labelled transitions; sees no picture and asks no model."""

    def learn(self, transitions: LabelledTransitions) -> Fit:
        """The operators of all skills, and what they leave inconsistent.

        Equal transitions give equal operators, whatever was learned before.
        """
        ...


LEARNERS: Mapping[str, Callable[[LearnerSettings], Learner]] = {
    "faithful": FaithfulLearner,
    "robust": RobustLearner,
}
"""The learners by their names in ``learning.learner``."""


def make_learner(settings: LearnerSettings) -> Learner:
    """The learner that the settings name.

    Raises:
        UnknownNameError: if there is none of this name.
    """
    if settings.learner not in LEARNERS:
        raise UnknownNameError("learner", settings.learner, LEARNERS)
    return LEARNERS[settings.learner](settings)


def learn_operators(
    transitions: LabelledTransitions,
    vocabulary: Sequence[Predicate] | None = None,
    learner: str = "faithful",
    settings: LearnerSettings | None = None,
) -> Fit:
    """Learn operators from labelled transitions, without pictures and without a model.

    Args:
        transitions: as ``label_entries`` or ``read_transitions`` makes them.
        vocabulary: the predicates to learn with; None for all that are labelled.
        learner: name of the learner.
        settings: of the learner; None for the defaults.

    Returns:
        The operators (``.model``) with what they leave inconsistent; see also ``certify`` and
        ``find_untested``.

    Raises:
        UnknownNameError: if there is no such learner, or a predicate is not labelled.
    """
    chosen = (settings or LearnerSettings()).model_copy(update={"learner": learner})
    words = transitions.predicates if vocabulary is None else vocabulary
    return make_learner(chosen).learn(transitions.with_predicates(words))

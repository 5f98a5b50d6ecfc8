"""Trying vocabularies: label what was recorded, then learn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import Learner
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions


@dataclass(frozen=True)
class Fitter:
    """Fits vocabularies to what was recorded.

    Attributes:
        labeller: labels the recorded transitions, which may grow.
        learner: learns operators from them.
    """

    labeller: Labeller
    learner: Learner

    @property
    def recorded(self) -> RecordedTransitions:
        """All transitions so far."""
        return self.labeller.recorded

    def fit(self, predicates: Sequence[Predicate]) -> Fit:
        """What is learned with a vocabulary."""
        return self.learner.learn(self.labeller.label(predicates))

"""Where things stand now, while skills are run one after the other and pictures are read."""

from __future__ import annotations

import numpy as np

from skillwrapper.grounding import Labels
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.planning.hypotheses.beliefs import GoalCandidates
from skillwrapper.planning.hypotheses.doubtful_planner import KnownScene
from skillwrapper.world.skills import SkillInstance


class StateFilter:
    """A probability for every state, kept up while things happen (a Bayes filter).

    Args:
        known: the scene.
        read: what was read (atoms,) at first.
    """

    def __init__(self, known: KnownScene, read: Labels) -> None:
        self._known = known
        self._probability = _shares(known.likely(read))

    @property
    def nats(self) -> Floats:
        """How likely each state (states,) is the present one, in nats."""
        tiny = np.finfo(np.float64).tiny
        return np.log(np.maximum(self._probability, tiny))

    @property
    def likeliest(self) -> Labels:
        """The likeliest state (atoms,)."""
        labels: Labels = self._known.possible.labels[int(self._probability.argmax())]
        return labels

    def reached(self, goals: GoalCandidates) -> float:
        """The probability that the goal holds now."""
        meant = _shares(goals.nats)
        held = [self._probability[list(states)].sum() for states in goals.goals]
        return float(np.array(held) @ meant)

    def look(self, read: Labels) -> None:
        """Take in what is read (atoms,) of another picture of the present state.

        Somebody may have moved something: any state may then be the present one.
        """
        readings = self._known.readings.log_likelihood(self._known.possible.labels, read)
        self._probability = _shares(np.log(self._or_any()) + readings)

    def ran(self, instance: SkillInstance, *, succeeded: bool) -> None:
        """Take in that a skill succeeded or failed; what the model did not expect of any state
        leaves all as it was."""
        expected = np.zeros_like(self._probability)
        for state, steps in enumerate(self._known.possible.steps):
            after = steps.get(instance)
            if (after is not None) is succeeded:
                expected[state if after is None else after] += self._probability[state]
        surprise = self._known.settings.surprise
        self._probability = (1 - surprise) * expected + surprise * self._probability
        self._probability /= self._probability.sum()

    def _or_any(self) -> Floats:
        """What is believed, but for a small share that belongs to all states alike."""
        surprise = self._known.settings.surprise
        mixed: Floats = (1 - surprise) * self._probability + surprise / len(self._probability)
        return mixed


def _shares(nats: Floats) -> Floats:
    weights = np.exp(nats - nats.max())
    shares: Floats = weights / weights.sum()
    return shares

"""Estimation: expectation and maximisation over hidden states, rules and error rates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import Labels
from skillwrapper.perception.decoding.cells import Cells
from skillwrapper.perception.decoding.conditions import Conditions
from skillwrapper.perception.decoding.messages import Joint, Messages
from skillwrapper.perception.decoding.odds import Floats, to_log_odds
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.decoding.readings import Readings
from skillwrapper.perception.decoding.rules import Readiness, Rules
from skillwrapper.perception.decoding.successes import idle_roles, needed

_STILL = 0.01
"""Rounds that change no belief by more have settled."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is to be decoded.

    Attributes:
        cells: which variables hang together.
        read: what was read of every variable (variables,).
        dirt: log-odds (pictures,) that a picture is dirty, if that is known.
        conditions: finds the variables of conditions.
        context: the probabilities of what is decoded already.
        changed: for every edge (edges,) the number of changes in what is decoded already; None if
            nothing is.
        priors: what is taken for likely beforehand.
    """

    cells: Cells
    read: Labels
    dirt: Floats | None
    conditions: Conditions
    context: Floats
    changed: Floats | None
    priors: Priors


class Estimation:
    """Climbs from one start to what explains the readings best nearby.

    Args:
        problem: what is to be decoded.

    Attributes:
        readings: the readings, with error rates.
        rules: how atoms change.
        belief: the probability (variables,) that an atom is true.
    """

    def __init__(self, problem: Problem) -> None:
        cells, priors = problem.cells, problem.priors
        self._problem = problem
        self.readings = Readings(cells, problem.read, priors, problem.dirt)
        self.rules = Rules(cells, problem.conditions, priors)
        self._messages = Messages(cells, to_log_odds(problem.context))
        self.belief: Floats = self.readings.first_belief
        self._joint = self._independent()
        self._needed: Floats = np.zeros(cells.variables)

    def climb(self, readiness: Readiness) -> None:
        """From what was read: rates of change first, then rules, then both.

        Error rates are left as they are until there are rules: before, a predicate that is hardly
        ever seen to change would be taken for one that is misread.
        """
        self.rules.learn_rates(self._joint, readiness)
        self._repeat(lambda: self.rules.learn_rates(self._joint, readiness))
        self._repeat(lambda: self._learn(free=False))
        self._repeat(lambda: self._learn(free=True))
        self._believe()

    def climb_from(self, belief: Floats) -> None:
        """From what is believed (variables,)."""
        self.belief = belief
        self._joint = self._independent()
        self._learn(free=True)
        self._repeat(lambda: self._learn(free=True))
        self._believe()

    def description(self) -> Floats:
        """The nats (predicates,) that the readings of each predicate take, with its rules."""
        return self.readings.misfit(self.belief) + self.rules.description()

    def _repeat(self, learn: Callable[[], None]) -> None:
        for _ in range(self._problem.priors.rounds):
            last = self.belief
            self._believe()
            learn()
            if np.abs(self.belief - last).max(initial=0.0) < _STILL:
                break

    def _believe(self) -> None:
        """Expectation: pass on what readings say by the rules as they are."""
        evidence = self.readings.evidence(self.belief)
        evidence += self.readings.starting() + self._needed
        self.belief, self._joint = self._messages.settle(
            evidence, self.rules.transitions(), self._problem.priors.sweeps
        )

    def _learn(self, *, free: bool) -> None:
        """Maximisation: error rates, rules, and what skills need, by what is believed."""
        problem = self._problem
        self.readings.learn(self.belief)
        idle = idle_roles(problem.cells, self._joint, problem.changed)
        belief = np.concatenate([self.belief, problem.context])
        self.rules.learn(self._joint, belief, idle, self.readings.misread, free=free)
        self._needed = needed(problem.cells, self.belief, self.readings.base, problem.priors)

    def _independent(self) -> Joint:
        """The joint probabilities of cells as if nothing hung together."""
        cells = self._problem.cells
        before, after = self.belief[cells.before], self.belief[cells.after]
        x, y = np.stack([1 - before, before], axis=1), np.stack([1 - after, after], axis=1)
        return Joint(x[:, :, None] * y[:, None, :])

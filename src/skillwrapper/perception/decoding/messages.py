"""Tree-reweighted belief propagation: what the pictures along a chain tell of each other.

Three messages a cell, as log-odds: forward to the variable after, backward to the variable before,
and to the variable of the condition that the cell's rule hangs on, if it does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillwrapper.perception.decoding.cells import Cells, Integers
from skillwrapper.perception.decoding.odds import Floats, to_probability

_LONGEST = 12.0
"""No message is surer than that: a rule learned from data never is."""
_DAMPING = 0.5
_STILL = 1e-3
"""Messages that change beliefs by less have settled."""


@dataclass(frozen=True)
class Transitions:
    """The probability that a cell's atom is true after, by what is true before.

    Attributes:
        table: (cells, 2, 2) by the truth of the condition, then of the atom before.
        condition: (cells,) the variable of the condition; -1 for none.
    """

    table: Floats
    condition: Integers


@dataclass(frozen=True)
class Joint:
    """What is believed of a cell's atom before and after.

    Attributes:
        probability: (cells, 2, 2) by the truth before, then after.
    """

    probability: Floats

    @property
    def change(self) -> Floats:
        """The probability (cells,) that the truth changes."""
        changed: Floats = self.probability[:, 0, 1] + self.probability[:, 1, 0]
        return changed


class Messages:
    """Passes messages until beliefs settle; remembers them from round to round.

    Args:
        cells: the cells.
        context: log-odds of variables that are decoded already, numbered after those of the cells.
    """

    def __init__(self, cells: Cells, context: Floats) -> None:
        self._cells, self._context = cells, context
        self._weight = cells.weight[cells.edge]
        size = len(cells.role)
        self._forward, self._backward, self._asked = (np.zeros(size) for _ in range(3))

    def settle(
        self, evidence: Floats, transitions: Transitions, sweeps: int
    ) -> tuple[Floats, Joint]:
        """The probability (variables,) that each atom is true, and the joint ones of all cells.

        Args:
            evidence: log-odds (variables,) from elsewhere.
            transitions: the rules of all cells.
            sweeps: how often messages are passed at most.
        """
        cells, condition = self._cells, transitions.condition
        hangs = np.flatnonzero(condition >= 0)
        self._asked[condition < 0] = 0.0
        factors = self._factors(transitions.table)
        odds = self._gather(evidence, condition, hangs)
        for _ in range(sweeps):
            before = to_probability(odds[cells.before] - self._backward)
            after = to_probability(odds[cells.after] - self._forward)
            given = self._ask(odds, condition, hangs, factors, before, after)
            self._pass(given, before, after)
            last, odds = odds, self._gather(evidence, condition, hangs)
            if np.abs(to_probability(odds) - to_probability(last)).max(initial=0.0) < _STILL:
                break
        before = to_probability(odds[cells.before] - self._backward)
        after = to_probability(odds[cells.after] - self._forward)
        return to_probability(odds), _joint(before, after, given)

    def _factors(self, table: Floats) -> Floats:
        """(cells, condition, before, after), to the power that makes up for the weight."""
        factors = np.stack([1 - table, table], axis=-1)
        cyclic = self._weight < 1
        power = 1 / self._weight[cyclic]
        factors[cyclic] = factors[cyclic] ** power[:, None, None, None]
        return factors

    def _ask(
        self,
        odds: Floats,
        condition: Integers,
        hangs: Integers,
        factors: Floats,
        before: Floats,
        after: Floats,
    ) -> Floats:
        """Factors (cells, before, after) as far as conditions hold; passes on what they tell."""
        given = factors[:, 0].copy()
        if len(hangs):
            known = np.concatenate([odds, self._context])[condition[hangs]]
            holds = to_probability(known - self._asked[hangs])[:, None, None]
            some = factors[hangs]
            given[hangs] = (1 - holds) * some[:, 0] + holds * some[:, 1]
            x, y = _pair(before[hangs]), _pair(after[hangs])
            likely = np.einsum("nx,ncxy,ny->nc", x, some, y)
            self._asked[hangs] = _blended(self._asked[hangs], likely)
        return given

    def _pass(self, given: Floats, before: Floats, after: Floats) -> None:
        """Pass messages forward and backward."""
        down = given[:, 0] + before[:, None] * (given[:, 1] - given[:, 0])
        up = given[:, :, 0] + after[:, None] * (given[:, :, 1] - given[:, :, 0])
        self._forward = _blended(self._forward, down)
        self._backward = _blended(self._backward, up)

    def _gather(self, evidence: Floats, condition: Integers, hangs: Integers) -> Floats:
        cells, size, weight = self._cells, len(evidence), self._weight
        odds = evidence + np.bincount(cells.after, weight * self._forward, size)
        odds += np.bincount(cells.before, weight * self._backward, size)
        own = hangs[condition[hangs] < size]
        odds += np.bincount(condition[own], weight[own] * self._asked[own], size)
        return odds


def _blended(messages: Floats, weights: Floats) -> Floats:
    """Messages (n,) moved towards those that weights (n, 2) of falsehood and truth give."""
    tiny = np.exp(-_LONGEST) * weights.sum(axis=1)
    fresh = np.log((weights[:, 1] + tiny) / (weights[:, 0] + tiny))
    blended: Floats = _DAMPING * messages + (1 - _DAMPING) * fresh
    return blended


def _pair(probability: Floats) -> Floats:
    """(n, 2) for falsehood and truth."""
    return np.stack([1 - probability, probability], axis=1)


def _joint(before: Floats, after: Floats, given: Floats) -> Joint:
    joint = _pair(before)[:, :, None] * given * _pair(after)[:, None, :]
    return Joint(joint / (joint.sum(axis=(1, 2), keepdims=True) + 1e-300))

"""Loopy belief propagation: what the pictures along a chain tell of each other.

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
        cells = self._cells
        hangs = np.flatnonzero(transitions.condition >= 0)
        self._asked[transitions.condition < 0] = 0.0
        odds = self._gather(evidence, transitions.condition, hangs)
        for _ in range(sweeps):
            before = to_probability(odds[cells.before] - self._backward)
            after = to_probability(odds[cells.after] - self._forward)
            reach = self._pass(odds, transitions, hangs, before, after)
            last, odds = odds, self._gather(evidence, transitions.condition, hangs)
            if np.abs(to_probability(odds) - to_probability(last)).max(initial=0.0) < _STILL:
                break
        before = to_probability(odds[cells.before] - self._backward)
        after = to_probability(odds[cells.after] - self._forward)
        return to_probability(odds), _joint(before, after, *reach)

    def _pass(
        self,
        odds: Floats,
        transitions: Transitions,
        hangs: Integers,
        before: Floats,
        after: Floats,
    ) -> tuple[Floats, Floats]:
        """Pass all messages once; the chance (cells,) of truth after from falsehood, from truth."""
        table = transitions.table
        from_false, from_true = table[:, 0, 0].copy(), table[:, 0, 1].copy()
        if len(hangs):
            asked = transitions.condition[hangs]
            known = np.concatenate([odds, self._context])[asked]
            holds = to_probability(known - self._asked[hangs])
            some = table[hangs]
            from_false[hangs] += holds * (some[:, 1, 0] - some[:, 0, 0])
            from_true[hangs] += holds * (some[:, 1, 1] - some[:, 0, 1])
            chance = some[:, :, 0] + before[hangs, None] * (some[:, :, 1] - some[:, :, 0])
            likely = 1 - chance + after[hangs, None] * (2 * chance - 1)
            _blend(self._asked, _log_ratio(likely[:, 1], likely[:, 0]), hangs)
        chance = from_false + before * (from_true - from_false)
        _blend(self._forward, _log_ratio(chance, 1 - chance))
        likely_true = 1 - from_true + after * (2 * from_true - 1)
        likely_false = 1 - from_false + after * (2 * from_false - 1)
        _blend(self._backward, _log_ratio(likely_true, likely_false))
        return from_false, from_true

    def _gather(self, evidence: Floats, condition: Integers, hangs: Integers) -> Floats:
        cells, size = self._cells, len(evidence)
        odds = evidence + np.bincount(cells.after, self._forward, size)
        odds += np.bincount(cells.before, self._backward, size)
        own = hangs[condition[hangs] < size]
        odds += np.bincount(condition[own], self._asked[own], size)
        return odds


def _blend(messages: Floats, fresh: Floats, where: Integers | slice = slice(None)) -> None:
    messages[where] = _DAMPING * messages[where] + (1 - _DAMPING) * fresh


def _log_ratio(one: Floats, other: Floats) -> Floats:
    tiny = np.exp(-_LONGEST)
    ratio: Floats = np.log((one + tiny) / (other + tiny))
    return ratio


def _joint(before: Floats, after: Floats, from_false: Floats, from_true: Floats) -> Joint:
    x = np.stack([1 - before, before], axis=1)[:, :, None]
    y = np.stack([1 - after, after], axis=1)[:, None, :]
    true = np.stack([from_false, from_true], axis=1)
    joint = x * y * np.stack([1 - true, true], axis=2)
    return Joint(joint / (joint.sum(axis=(1, 2), keepdims=True) + 1e-12))

"""Readings of pictures, and how often they are wrong.

Errors come together: a picture is *clean*, then hardly anything in it is misread, or *dirty*. Every
predicate has its own rates of false positives and negatives in dirty pictures.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE, UNKNOWN, Labels
from skillwrapper.perception.decoding.cells import Cells
from skillwrapper.perception.decoding.odds import Floats, to_probability
from skillwrapper.perception.decoding.priors import Priors, rate

_MOST = 0.45
"""A reading is worth something: it is rather right than wrong."""
_CLEAN = 0.1
"""Clean pictures have fewer errors than pictures at large by an order of magnitude."""


@dataclass(frozen=True)
class ErrorRates:
    """How often readings of a predicate are wrong, as estimated without the truth.

    Attributes:
        false_positive: share of the false atoms that are read as true, 0 to 1.
        false_negative: share of the true atoms that are read as false, 0 to 1.
        negatives: how many readings were of false atoms.
        positives: how many readings were of true ones.
    """

    false_positive: float
    false_negative: float
    negatives: float
    positives: float


class Readings:
    """What was read, and what each reading is worth.

    Args:
        cells: says which variable is of which predicate and picture.
        labels: what was read (variables,).
        priors: what is taken for likely beforehand.
        dirt: log-odds (pictures,) that a picture is dirty, if that is known.

    Attributes:
        known: whether a variable (variables,) was read.
        says: whether it was read as true (variables,).
        dirt: log-odds (pictures,) that a picture is dirty, as estimated.
        base: for every predicate the share of its atoms that is true.
        misread: for every predicate the share of its readings that is wrong.
    """

    def __init__(
        self, cells: Cells, labels: Labels, priors: Priors, dirt: Floats | None = None
    ) -> None:
        self._cells, self._priors, self._dirt_known = cells, priors, dirt
        self.known: NDArray[np.bool_] = labels != UNKNOWN
        self.says: NDArray[np.bool_] = labels == TRUE
        number = len(cells.predicates)
        self.base: Floats = np.full(number, 0.5)
        self._share = 0.5  # of dirty pictures
        self._clean = _CLEAN * priors.misread
        self._dirty: Floats = np.full((2, number), priors.misread / self._share)
        self._all: Floats = np.full((2, number), priors.misread)
        self._seen: Floats = np.zeros((2, number))
        self.misread: Floats = np.full(number, priors.misread)
        self.dirt: Floats = np.zeros(cells.pictures) if dirt is None else dirt

    @property
    def first_belief(self) -> Floats:
        """The probability (variables,) that an atom is true, by its reading alone."""
        right = np.where(self.says, 1 - self._priors.misread, self._priors.misread)
        return np.where(self.known, right, 0.5)

    def evidence(self, belief: Floats) -> Floats:
        """Log-odds (variables,) that readings give, while the others of a picture are believed.

        Args:
            belief: the probability (variables,) that an atom is true.
        """
        cells, p = self._cells, self._cells.predicate
        true_dirty, false_dirty = self._likelihoods(self._dirty[0][p], self._dirty[1][p])
        clean = np.full(len(p), self._clean)
        true_clean, false_clean = self._likelihoods(clean, clean)
        gain = belief * np.log(true_dirty / true_clean)
        gain += (1 - belief) * np.log(false_dirty / false_clean)
        prior = np.log(self._share / (1 - self._share))
        prior = np.full(cells.pictures, prior) if self._dirt_known is None else self._dirt_known
        self.dirt = prior + np.bincount(cells.picture, gain, cells.pictures)
        dirty = to_probability(
            self.dirt[cells.picture] - gain
        )  # by all other readings of the picture
        odds: Floats = np.log(dirty * true_dirty + (1 - dirty) * true_clean)
        odds -= np.log(dirty * false_dirty + (1 - dirty) * false_clean)
        return odds

    def starting(self) -> Floats:
        """Log-odds (variables,) by how often atoms of the predicate are true; 0 after a step."""
        base = np.clip(self.base, self._priors.misread, 1 - self._priors.misread)
        odds = np.log(base / (1 - base))[self._cells.predicate]
        return np.where(self._cells.follows, 0.0, odds)

    def learn(self, belief: Floats) -> None:
        """Estimate all rates anew from what is believed (variables,)."""
        weights = np.stack([1 - belief, belief]) * self.known
        wrong = weights * np.stack([self.says, ~self.says])
        dirty = to_probability(self.dirt)
        of_dirty = dirty[self._cells.picture]
        prior = self._priors.misread
        self._share = (dirty.sum() + 1) / (len(dirty) + 2)
        for side in range(2):
            self._seen[side] = self._count(weights[side])
            self._all[side] = _rates(self._count(wrong[side]), self._seen[side], prior)
            dirty_wrong = self._count(of_dirty * wrong[side])
            dirty_seen = self._count(of_dirty * weights[side])
            mean = min(_MOST, prior / self._share)
            self._dirty[side] = _rates(dirty_wrong, dirty_seen, mean)
        self.misread = _rates(self._count(wrong.sum(axis=0)), self._seen.sum(axis=0), prior)
        clean = 1 - of_dirty
        self._clean = rate(
            float((clean * wrong).sum()), float((clean * weights).sum()), _CLEAN * prior
        )
        ones, seen = self._count(belief), self._count(np.ones_like(belief))
        self.base = (ones + 1) / (seen + 2)

    def rates(self) -> tuple[ErrorRates, ...]:
        """The rates of every predicate, over all pictures."""
        columns = (*self._all, *self._seen)
        return tuple(ErrorRates(*map(float, row)) for row in zip(*columns, strict=True))

    def misfit(self, belief: Floats) -> Floats:
        """How little the readings of each predicate (predicates,) fit what is believed, in nats."""
        p = self._cells.predicate
        true, false = self._likelihoods(self._all[0][p], self._all[1][p])
        misfit: Floats = -self._count(np.log(np.where(belief > 0.5, true, false)))
        return misfit

    def _likelihoods(self, false_positive: Floats, false_negative: Floats) -> tuple[Floats, Floats]:
        """Of each reading (variables,) if its atom is true, and if it is false; 1 for none."""
        true = np.where(self.says, 1 - false_negative, false_negative)
        false = np.where(self.says, false_positive, 1 - false_positive)
        return np.where(self.known, true, 1.0), np.where(self.known, false, 1.0)

    def _count(self, weights: Floats) -> Floats:
        number = len(self._cells.predicates)
        counted: Floats = np.bincount(self._cells.predicate, weights, number).astype(np.float64)
        return counted


def _rates(wrong: Floats, seen: Floats, mean: float) -> Floats:
    pairs = zip(wrong.tolist(), seen.tolist(), strict=True)
    return np.array([min(_MOST, rate(w, n, mean)) for w, n in pairs])

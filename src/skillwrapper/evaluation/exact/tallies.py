"""Counting how often predictions are right; a share of nothing is undefined, and never 1."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np

from skillwrapper.evaluation.exact.predictions import Predictions


@dataclass(frozen=True)
class Tally:
    """Counts over pairs of state and skill instance; those of several scenes add up.

    Attributes:
        predicted: pairs predicted to succeed.
        successes: pairs that truly succeed.
        hits: pairs that are both.
        effects_made: changes that applicable ground operators predict for successes.
        effects_right: those that are exactly what is read afterwards.
    """

    predicted: int = 0
    successes: int = 0
    hits: int = 0
    effects_made: int = 0
    effects_right: int = 0

    def __add__(self, other: Tally) -> Tally:
        return Tally(*(a + b for a, b in zip(astuple(self), astuple(other), strict=True)))

    @property
    def precision(self) -> float | None:
        """Of the pairs predicted to succeed, the share that does; None if there are none."""
        return share(self.hits, self.predicted)

    @property
    def recall(self) -> float | None:
        """Of the pairs that succeed, the share predicted to; None if there are none."""
        return share(self.hits, self.successes)

    @property
    def effect_accuracy(self) -> float | None:
        """Of the predicted changes, the share that is right; None if there are none."""
        return share(self.effects_right, self.effects_made)


def tally_by_skill(predictions: Predictions) -> dict[str, Tally]:
    """Counts of every skill."""
    space, applicable = predictions.space, predictions.applicable
    hits = space.success & applicable
    skills = np.array([instance.skill for instance in space.instances])
    return {
        name: Tally(
            predicted=int(applicable[:, skills == name].sum()),
            successes=int(space.success[:, skills == name].sum()),
            hits=int(hits[:, skills == name].sum()),
            effects_made=int(predictions.effects_made[skills == name].sum()),
            effects_right=int(predictions.effects_right[skills == name].sum()),
        )
        for name in dict.fromkeys(skills.tolist())
    }


def share(part: int, whole: int) -> float | None:
    """A part of a whole, from 0 to 1; None of nothing (docs/semantics.md, D25)."""
    return part / whole if whole else None


def worded(figure: float | None, decimals: int = 3) -> str:
    """A share for people."""
    return "undefined" if figure is None else f"{figure:.{decimals}f}"

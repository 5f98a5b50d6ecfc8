"""Whether a vocabulary tells apart what truly differs.

A model can predict perfectly in a vocabulary that lacks what matters: a skill whose only effect no
predicate names then "changes nothing", and rightly so. Where a simulator tells what is true, this
is seen: a fact that varies between states should be a function of the labels.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from skillwrapper.evaluation.exact.tallies import share
from skillwrapper.grounding import Labels
from skillwrapper.symbols import Atom


@dataclass(frozen=True)
class Vocabulary:
    """What a vocabulary determines of the truth; that of several scenes adds up.

    Attributes:
        varying: number of ground facts that are true in some states and false in others.
        undetermined: those of which the labels do not tell whether they are true.
    """

    varying: int
    undetermined: tuple[Atom, ...]

    def __add__(self, other: Vocabulary) -> Vocabulary:
        return Vocabulary(self.varying + other.varying, (*self.undetermined, *other.undetermined))

    @property
    def share(self) -> float | None:
        """Share of the varying facts that the labels determine; None if no fact varies."""
        return share(self.varying - len(self.undetermined), self.varying)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        facts = [str(atom) for atom in self.undetermined]
        return {"share": self.share, "varying": self.varying, "undetermined": facts}


def vocabulary_of(facts: Sequence[Iterable[Atom]], labels: Labels) -> Vocabulary:
    """Compare true facts with labels.

    Args:
        facts: the true facts of every state.
        labels: of the same states (states, atoms).
    """
    truths = [frozenset(true) for true in facts]
    _, looks = np.unique(labels, axis=0, return_inverse=True)
    looks = looks.reshape(-1)  # numpy 2.0 gives it the shape of a column
    sizes = np.bincount(looks)
    varying, undetermined = 0, []
    for atom in sorted(frozenset().union(*truths)):
        holds = np.array([atom in true for true in truths])
        if holds.all():
            continue
        varying += 1
        times = np.bincount(looks, weights=holds)
        if ((times != 0) & (times != sizes)).any():
            undetermined.append(atom)
    return Vocabulary(varying, tuple(undetermined))

"""Which conditions of an operator are not met where it might be tried, binding by binding."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE
from skillwrapper.grounding.abstract_states import different_rows
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings

MOST_UNMET = 6
"""Bindings with more unmet conditions count as ones that cannot apply."""


@dataclass(frozen=True, eq=False)
class UnmetConditions:
    """Which conditions of an operator are not surely met where it might be tried.

    Attributes:
        sets: different sets of conditions (sets, conditions).
        families: different families of them, one set a binding, as places among the sets
            (families, bindings); places that are not used are -1.
        family: the family (attempts,) of every attempt; -1 for one that no binding fits.
    """

    sets: NDArray[np.bool_]
    families: NDArray[np.intp]
    family: NDArray[np.intp]

    @classmethod
    def of(cls, operator: IndexedOperator, attempts: Attempts) -> UnmetConditions:
        """Look at all bindings that lack not too much."""
        unmet = [np.zeros((0, len(operator.conditions)), dtype=bool)]
        attempt = [np.zeros(0, dtype=np.intp)]
        for bindings in find_bindings(operator, attempts, most_unmet=MOST_UNMET):
            unmet.append(bindings.met() != TRUE)
            attempt.append(bindings.attempt)
        rows, owner = np.vstack(unmet), np.concatenate(attempt)
        first, place = different_rows(rows)
        pairs = np.column_stack([owner, place])
        pairs = pairs[np.sort(different_rows(pairs)[0])]
        pairs = pairs[np.argsort(pairs[:, 0], kind="stable")]
        turn = np.arange(len(pairs)) - np.searchsorted(pairs[:, 0], pairs[:, 0])
        members = np.full((len(attempts), int(turn.max(initial=0)) + 1), -1, dtype=np.intp)
        members[pairs[:, 0], turn] = pairs[:, 1]
        bound = members[:, 0] >= 0
        family = np.full(len(attempts), -1, dtype=np.intp)
        one_each, family[bound] = different_rows(members[bound])
        return cls(rows[first], members[bound][one_each], family)

    def excused(self, needed: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Whether some binding would apply (families, hypotheses).

        Args:
            needed: every hypothesis as the conditions that it needs (hypotheses, conditions).
        """
        overlap = self.sets.astype(np.float32) @ needed.T.astype(np.float32)
        applies = np.vstack([overlap == 0, np.zeros((1, len(needed)), dtype=bool)])
        found = np.zeros((len(self.families), len(needed)), dtype=bool)
        for column in self.families.T:
            found |= applies[column]  # place -1 is the last row, which never applies
        return found

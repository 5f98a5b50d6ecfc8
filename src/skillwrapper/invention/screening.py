"""What a candidate must show before it is labelled everywhere: that costs few readings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.steadiness import Steadiness
from skillwrapper.invention.witnesses import Witnesses
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate

ALIKE = "does not tell the two transitions apart"
UNSTEADY = "reads differently at starts that are the same state"


class Screen:
    """Sorts out candidates by the pictures of the inconsistency, then by those of the starts.

    Args:
        labeller: holds the transitions, and labels their pictures.
        steadiness: knows the starts; None if these need not be alike.
        settings: whether the inconsistency is looked at, and how much of it.
    """

    def __init__(
        self, labeller: Labeller, steadiness: Steadiness | None, settings: LearningSettings
    ) -> None:
        self._labeller = labeller
        self._steadiness = steadiness
        self._settings = settings

    def flaws(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate]
    ) -> Iterator[tuple[Predicate, str]]:
        """What is wrong with each candidate, in their order; empty if nothing is."""
        alike = self._alike(inconsistency, candidates) if self._settings.screen else set()
        telling = [p for p in candidates if p not in alike]
        unsteady = self._steadiness.unsteady(telling) if self._steadiness else ()
        for predicate in candidates:
            yield predicate, _flaw(predicate in alike, predicate in unsteady)

    def _alike(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate]
    ) -> set[Predicate]:
        """Those that tell the culprit from none of its partners."""
        alike = set(candidates)
        for pair in inconsistency.pairs if self._settings.rotate else (inconsistency,):
            left = [p for p in candidates if p in alike]
            witnesses = Witnesses(self._labeller, pair)
            witnesses.look(left)
            alike -= {p for p in left if witnesses.are_told_apart(p)}
        return alike


def _flaw(is_alike: bool, is_unsteady: bool) -> str:
    return ALIKE if is_alike else UNSTEADY if is_unsteady else ""

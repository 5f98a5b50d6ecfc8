"""What a candidate must show before it is labelled everywhere: that costs few readings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillwrapper.grounding import AtomSpace
from skillwrapper.invention.look_alikes import look_alikes, tells_more
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.steadiness import Steadiness
from skillwrapper.invention.witnesses import Witnesses
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.labelling import Labeller, TruthSource
from skillwrapper.symbols import Predicate

ALIKE = "does not tell the two transitions apart"
NOTHING_NEW = "tells no pictures apart that look alike so far"
UNSTEADY = "reads differently where the state is the same"


class Screen:
    """Sorts out candidates by the pictures of the inconsistency, then by those of the starts.

    Args:
        labeller: holds the transitions, and labels their pictures.
        steadiness: knows which pictures show the same state.
        settings: whether the inconsistency is looked at, and how much of it.
    """

    def __init__(
        self, labeller: Labeller, steadiness: Steadiness, settings: LearningSettings
    ) -> None:
        self._labeller = labeller
        self._steadiness = steadiness
        self._settings = settings

    def look(
        self, due: Sequence[tuple[Predicate, Inconsistency]], vocabulary: Sequence[Predicate]
    ) -> None:
        """Have the pictures read together by which candidates for unnoticed changes are judged.

        Args:
            due: the candidates, with what each was proposed for.
            vocabulary: what is known already.
        """
        steady = self._steadiness.pictures() if self._settings.steady else []
        wanted = [
            (p, scene, pictures)
            for p, asked in due
            for scene, pictures in (*steady, look_alikes(self._labeller, vocabulary, asked))
        ]
        self._labeller.truth.prefetch(
            (AtomSpace((p,), scene.objects), pictures) for p, scene, pictures in wanted
        )

    def flaws(
        self,
        inconsistency: Inconsistency,
        candidates: Sequence[Predicate],
        vocabulary: Sequence[Predicate],
    ) -> Iterator[tuple[Predicate, str]]:
        """What is wrong with each candidate, in their order; empty if nothing is.

        Args:
            inconsistency: what they were proposed for.
            candidates: the candidates.
            vocabulary: what is known already.
        """
        flaws: dict[Predicate, str] = {}
        if self._settings.screen:
            flaws |= dict.fromkeys(self._alike(inconsistency, candidates), ALIKE)
        telling = [p for p in candidates if p not in flaws]
        if self._settings.steady:
            flaws |= dict.fromkeys(self._steadiness.unsteady(telling), UNSTEADY)
        if inconsistency.kind is InconsistencyKind.UNNOTICED and vocabulary:
            telling = [p for p in candidates if p not in flaws]
            more = tells_more(self._labeller, vocabulary, inconsistency, telling)
            flaws |= {p: NOTHING_NEW for p in telling if p not in more}
        for predicate in candidates:
            yield predicate, flaws.get(predicate, "")

    def _alike(
        self, inconsistency: Inconsistency, candidates: Sequence[Predicate]
    ) -> set[Predicate]:
        """Those that tell the culprit from none of its partners.

        Where readings may be wrong, the very difference may be misread. A question about a picture
        costs as much for one candidate as for many: as soon as one is to be read everywhere, all
        are. If none is, all are read in the pictures around too, and decoded.
        """
        pairs = inconsistency.pairs if self._settings.rotate else (inconsistency,)
        alike = self._told_by_none(pairs, candidates, self._labeller.truth)
        numbers = {n for pair in pairs for n in (pair.first, pair.second) if n is not None}
        around = self._labeller.around(sorted(numbers))
        if around is None:
            return alike
        if len(alike) < len(candidates):
            return set()
        return self._told_by_none(pairs, candidates, around)

    def _told_by_none(
        self, pairs: Sequence[Inconsistency], candidates: Sequence[Predicate], truth: TruthSource
    ) -> set[Predicate]:
        """The candidates that tell the transitions of no pair apart."""
        alike = set(candidates)
        for pair in pairs:
            left = [p for p in candidates if p in alike]
            witnesses = Witnesses(self._labeller.recorded, truth, pair)
            witnesses.look(left)
            alike -= {p for p in left if witnesses.are_told_apart(p)}
        return alike

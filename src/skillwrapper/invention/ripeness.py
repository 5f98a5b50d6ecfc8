"""Which inconsistencies are worth a question: those that no misreading explains better (D24)."""

from __future__ import annotations

from collections.abc import Sequence

from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate

_CLEAN = 0.5
"""What is rather read without any error than with one cannot be blamed on an error."""
_PICTURES = 4
"""So many pictures are not misread alike by chance; as measured (docs/results/robustness.md)."""
_YOUNG = 3
"""So few predicates constrain nothing: of what they say nobody can tell what is misread."""
_WAIT = 2
"""What was seen last is misread most easily: so many further pictures are waited for."""

Cause = tuple[str, InconsistencyKind]
"""The skill of inconsistencies, and their kind."""


class Ripeness:
    """Tells ripe causes from suspected misreadings.

    Args:
        labeller: knows how much pictures are to be doubted.
    """

    def __init__(self, labeller: Labeller) -> None:
        self._labeller = labeller
        self._known: frozenset[Cause] = frozenset()
        self._since: dict[Cause, int] = {}

    def look(self, found: Sequence[Inconsistency]) -> None:
        """Take note of what new data have made inconsistent, with the vocabulary as it was.

        Args:
            found: what is inconsistent now.
        """
        if self._labeller.misread:
            causes = {(one.skill, one.kind) for one in found}
            new = causes - self._known - self._since.keys()
            waiting = {cause: n for cause, n in self._since.items() if cause in causes}
            self._since = waiting | dict.fromkeys(new, self._pictures)

    def leave(self, found: Sequence[Inconsistency]) -> None:
        """Take note of what is inconsistent after a look, perhaps with another vocabulary.

        Args:
            found: what is inconsistent now; what is not waited for counts as known.
        """
        causes = {(one.skill, one.kind) for one in found}
        self._known = frozenset(causes - {c for c in self._since if self._waits(c)})

    @property
    def _pictures(self) -> int:
        recorded = self._labeller.recorded
        return sum(len(recorded.observations(scene)) for scene in recorded.scenes)

    def _waits(self, cause: Cause) -> bool:
        return self._pictures < self._since.get(cause, -_WAIT) + _WAIT

    def ripe(
        self, found: Sequence[Inconsistency], vocabulary: Sequence[Predicate]
    ) -> tuple[Inconsistency, ...]:
        """Those of ripe causes, what is likeliest read rightly first.

        All of one skill and kind are ripe if one of them is seen where everything was likely read
        rightly, or if they are seen in several pictures; but not as soon as new data bring them up:
        one picture more may show that the last one was misread.

        Args:
            found: inconsistencies.
            vocabulary: the predicates in use.
        """
        doubts = [self._labeller.doubt(one.culprit) for one in found]
        least: dict[Cause, float] = {}
        pictures: dict[Cause, set[int]] = {}
        for one, doubt in zip(found, doubts, strict=True):
            cause = (one.skill, one.kind)
            least[cause] = min(doubt, least.get(cause, 1.0))
            before = self._labeller.recorded.records[one.culprit].before
            pictures.setdefault(cause, set()).add(before)
        young = len(vocabulary) < _YOUNG
        ripe = {
            cause
            for cause, doubt in least.items()
            if young
            or ((doubt < _CLEAN or len(pictures[cause]) >= _PICTURES) and not self._waits(cause))
        }
        order = sorted(range(len(found)), key=lambda place: doubts[place])
        return tuple(found[n] for n in order if (found[n].skill, found[n].kind) in ripe)

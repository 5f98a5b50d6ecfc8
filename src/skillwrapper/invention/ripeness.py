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


class Ripeness:
    """Tells ripe causes from suspected misreadings.

    Args:
        labeller: knows how much pictures are to be doubted.
    """

    def __init__(self, labeller: Labeller) -> None:
        self._labeller = labeller

    def ripe(
        self, found: Sequence[Inconsistency], vocabulary: Sequence[Predicate]
    ) -> tuple[Inconsistency, ...]:
        """Those of ripe causes, what is likeliest read rightly first.

        All of one skill and kind are ripe if one of them is seen where everything was likely read
        rightly, or if they are seen in several pictures.

        Args:
            found: inconsistencies.
            vocabulary: the predicates in use.
        """
        doubts = [self._labeller.doubt(one.culprit) for one in found]
        least: dict[tuple[str, InconsistencyKind], float] = {}
        pictures: dict[tuple[str, InconsistencyKind], set[int]] = {}
        for one, doubt in zip(found, doubts, strict=True):
            cause = (one.skill, one.kind)
            least[cause] = min(doubt, least.get(cause, 1.0))
            before = self._labeller.recorded.records[one.culprit].before
            pictures.setdefault(cause, set()).add(before)
        ripe = {
            cause
            for cause, doubt in least.items()
            if doubt < _CLEAN or len(pictures[cause]) >= _PICTURES or len(vocabulary) < _YOUNG
        }
        order = sorted(range(len(found)), key=lambda place: doubts[place])
        return tuple(found[n] for n in order if (found[n].skill, found[n].kind) in ripe)

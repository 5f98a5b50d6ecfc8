"""What was rejected, and for what: of no use for one cause, a candidate may help with another."""

from __future__ import annotations

from collections.abc import Iterable

from skillwrapper.learning.inconsistencies import Identity
from skillwrapper.symbols import Predicate


class Rejections:
    """Remembers rejected candidates (D8).

    Args:
        by_cause: whether those of every inconsistency by itself, or all for all.
    """

    def __init__(self, *, by_cause: bool = True) -> None:
        self._keeps_apart = by_cause
        self._by_cause: dict[Identity, dict[Predicate, None]] = {}
        self._everywhere: dict[Predicate, None] = {}
        self._for_good: dict[Predicate, None] = {}

    def of(self, cause: Identity) -> tuple[Predicate, ...]:
        """What need not be tried for a cause, in the order of its rejection."""
        causes = (cause,) if self._keeps_apart else tuple(self._by_cause)
        own = (p for c in causes for p in self._by_cause.get(c, {}))
        return tuple(dict.fromkeys((*self._for_good, *self._everywhere, *own)))

    def reject(self, predicate: Predicate, cause: Identity) -> None:
        """Remember a candidate that did not help with one cause."""
        self._by_cause.setdefault(cause, {})[predicate] = None

    def retract(self, predicates: Iterable[Predicate]) -> None:
        """Remember what was taken back: it is of no use for any cause, until there are new data."""
        self._everywhere.update(dict.fromkeys(predicates))

    def ban(self, predicates: Iterable[Predicate]) -> None:
        """Remember what can be no predicate of the state, whatever the data."""
        self._for_good.update(dict.fromkeys(predicates))

    def admit_data_of(self, skills: Iterable[str]) -> None:
        """Let lapse what new data of some skills may decide otherwise."""
        new = frozenset(skills)
        self._by_cause = {c: known for c, known in self._by_cause.items() if c[0] not in new}
        if new:
            self._everywhere.clear()

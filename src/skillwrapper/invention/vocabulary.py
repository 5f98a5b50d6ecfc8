"""The vocabulary: predicates in use, dormant ones, and the memory of rejected candidates."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace

from skillwrapper.symbols import Predicate
from skillwrapper.world.types import TypeHierarchy


class Vocabulary:
    """Predicates in the order of their invention.

    Attributes:
        active: predicates that take part in learning.
        dormant: predicates set aside; they keep their labels and are tried again before the
            model is asked (DESIGN.md D9).
        rejected: candidates rejected since the vocabulary last changed (D8).
    """

    def __init__(self, types: TypeHierarchy, active: Sequence[Predicate] = ()) -> None:
        self._types = types
        self.active: tuple[Predicate, ...] = tuple(active)
        self.dormant: tuple[Predicate, ...] = ()
        self.rejected: tuple[Predicate, ...] = ()

    def fresh(self, proposed: Iterable[Predicate]) -> tuple[Predicate, ...]:
        """The proposed predicates that are new; one known for another type is widened (D3)."""
        known = {*self.active, *self.dormant, *self.rejected}
        chosen: dict[str, Predicate] = {}
        for predicate in proposed:
            candidate = self._reconcile(predicate)
            if candidate not in known:
                chosen.setdefault(candidate.name, candidate)
        return tuple(chosen.values())

    def with_candidate(self, predicate: Predicate) -> tuple[Predicate, ...]:
        """The active predicates with a candidate, which replaces one of its name."""
        return (*(p for p in self.active if p.name != predicate.name), predicate)

    def accept(self, predicate: Predicate) -> None:
        """Take a candidate or a dormant predicate into use; rejections lapse."""
        self.active = self.with_candidate(predicate)
        self.dormant = tuple(p for p in self.dormant if p.name != predicate.name)
        self.rejected = ()

    def reject(self, predicate: Predicate) -> None:
        """Remember a candidate that did not help."""
        if predicate not in self.rejected:
            self.rejected = (*self.rejected, predicate)

    def forget_rejections(self) -> None:
        """Let all rejections lapse."""
        self.rejected = ()

    def set_dormant(self, predicate: Predicate) -> None:
        """Take a predicate out of use; rejections lapse."""
        self.active = tuple(p for p in self.active if p != predicate)
        self.dormant = (*self.dormant, predicate)
        self.rejected = ()

    def retract(self, predicates: Collection[Predicate]) -> None:
        """Take accepted predicates back: they count as rejected, all other rejections lapse."""
        self.active = tuple(p for p in self.active if p not in predicates)
        self.rejected = tuple(predicates)

    def _reconcile(self, predicate: Predicate) -> Predicate:
        """Resolve a clash of names: widen the types if possible, else rename."""
        known = {p.name: p for p in (*self.active, *self.dormant)}
        namesake = known.get(predicate.name, predicate)
        if namesake.types == predicate.types:
            return predicate
        widened = self._widen(namesake, predicate)
        if widened is not None:
            return widened
        name = predicate.name
        while known.get(name, predicate).types != predicate.types:
            name = "_".join((name, *(predicate.types or ("scene",))))
        return replace(predicate, name=name)

    def _widen(self, known: Predicate, other: Predicate) -> Predicate | None:
        if known.arity != other.arity:
            return None
        types = [self._common(a, b) for a, b in zip(known.types, other.types, strict=True)]
        if None in types:
            return None
        return replace(known, types=tuple(t for t in types if t is not None))

    def _common(self, first: str, second: str) -> str | None:
        """The most specific type that covers both."""
        shared = self._types.ancestors[first] & self._types.ancestors[second]
        specific = self._types.most_specific(shared)
        return specific[0] if specific else None

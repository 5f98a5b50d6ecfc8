"""The vocabulary: predicates in use, and dormant ones."""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace

from skillwrapper.invention.shaping import with_types
from skillwrapper.symbols import Predicate
from skillwrapper.world.types import TypeHierarchy


class Vocabulary:
    """Predicates in the order of their invention.

    Attributes:
        active: predicates that take part in learning.
        dormant: predicates set aside; they keep their labels and are tried again before the
            model is asked (D9).
        changes: names of predicates that were taken for what else a skill changes (D26): nothing
            need hang on them but goals.
    """

    def __init__(
        self,
        types: TypeHierarchy,
        active: Sequence[Predicate] = (),
        dormant: Sequence[Predicate] = (),
    ) -> None:
        self._types = types
        self.active: tuple[Predicate, ...] = tuple(active)
        self.dormant: tuple[Predicate, ...] = tuple(dormant)
        self.changes: frozenset[str] = frozenset()

    @property
    def dormant_changes(self) -> tuple[Predicate, ...]:
        """Dormant predicates that were taken for a change alone."""
        return tuple(p for p in self.dormant if p.name in self.changes)

    def fresh(
        self, proposed: Iterable[Predicate], rejected: Iterable[Predicate] = ()
    ) -> tuple[Predicate, ...]:
        """The proposed predicates that are new.

        One known for another type is widened (docs/semantics.md, D3), also under another name; one
        that shares its name with another meaning gets another name.

        Args:
            proposed: candidates.
            rejected: what need not be tried.
        """
        known = {_identity(p) for p in (*self.active, *self.dormant, *rejected)}
        chosen: dict[str, Predicate] = {}
        for predicate in proposed:
            candidate = self._reconcile(predicate)
            if _identity(candidate) not in known:
                chosen.setdefault(candidate.name, candidate)
        return tuple(chosen.values())

    def wider(self, types: Collection[str]) -> tuple[Predicate, ...]:
        """The active predicates, said of wider types, where some of the types are wider.

        What is told of doors may be what matters of other passages.
        """
        found: dict[Predicate, None] = {}
        for predicate in self.active:
            for place, own in enumerate(predicate.types):
                for wide in types:
                    if wide != own and wide in self._types.ancestors[own]:
                        changed = [*predicate.types]
                        changed[place] = wide
                        found[with_types(predicate, changed)] = None
        return tuple(found)

    def with_candidate(self, predicate: Predicate) -> tuple[Predicate, ...]:
        """The active predicates with a candidate, which replaces one of its name."""
        return (*(p for p in self.active if p.name != predicate.name), predicate)

    def accept(self, predicate: Predicate, *, for_change: bool = False) -> None:
        """Take a candidate or a dormant predicate into use, perhaps for a change alone (D26)."""
        if for_change:
            self.changes |= {predicate.name}
        self.active = self.with_candidate(predicate)
        self.dormant = tuple(p for p in self.dormant if p.name != predicate.name)

    def set_dormant(self, predicate: Predicate) -> None:
        """Take a predicate out of use."""
        self.active = tuple(p for p in self.active if p != predicate)
        self.dormant = (*self.dormant, predicate)

    def drop(self, predicates: Collection[Predicate]) -> None:
        """Forget predicates, active or dormant."""
        self.active = tuple(p for p in self.active if p not in predicates)
        self.dormant = tuple(p for p in self.dormant if p not in predicates)

    def use(self, predicates: Sequence[Predicate]) -> None:
        """Take exactly these into use; what was active is dormant."""
        names = {p.name for p in predicates}
        others = (p for p in (*self.active, *self.dormant) if p.name not in names)
        self.active, self.dormant = tuple(predicates), tuple(dict.fromkeys(others))

    def _reconcile(self, predicate: Predicate) -> Predicate:
        """Resolve a clash of names: the known one, a wider one, or else another name."""
        known = {p.name: p for p in (*self.active, *self.dormant)}
        for other in (p for p in known.values() if _is_synonym(p, predicate)):
            if wider := self._widen(other, predicate):
                return wider
        wider_by_name = {
            name: self._widen(namesake, predicate)
            for name, namesake in known.items()
            if _mean_the_same(namesake, predicate)
        }
        names = _names(predicate, known.get(predicate.name))
        name = next(n for n in names if n not in known or wider_by_name.get(n) is not None)
        return wider_by_name.get(name) or replace(predicate, name=name)

    def _widen(self, known: Predicate, other: Predicate) -> Predicate | None:
        if known.arity != other.arity:
            return None
        types = [self._common(a, b) for a, b in zip(known.types, other.types, strict=True)]
        if None in types:
            return None
        return with_types(known, [t for t in types if t is not None])

    def _common(self, first: str, second: str) -> str | None:
        """The most specific type that covers both."""
        shared = self._types.ancestors[first] & self._types.ancestors[second]
        specific = self._types.most_specific(shared)
        return specific[0] if specific else None


def _names(predicate: Predicate, namesake: Predicate | None) -> Iterator[str]:
    """Names for a predicate, its own first, then those that tell it from its namesake."""
    yield predicate.name
    name = predicate.name
    if namesake is not None and namesake.types != predicate.types:
        name = "_".join((name, *(predicate.types or ("scene",))))
        yield name
    for number in itertools.count(2):
        yield f"{name}_{number}"


def _mean_the_same(known: Predicate, other: Predicate) -> bool:
    """Whether two predicates of one name say the same, if perhaps of other types.

    One that comes without a meaning means what the known one does.
    """
    as_known = replace(other, types=known.types) if known.arity == other.arity else other
    return not other.semantics or _meaning(known) in (_meaning(other), _meaning(as_known))


def _is_synonym(known: Predicate, other: Predicate) -> bool:
    """Whether two predicates of different names have one meaning, in so many words."""
    same = bool(other.semantics) and _mean_the_same(known, other)
    return same and known.name != other.name


def _identity(predicate: Predicate) -> tuple[str, tuple[str, ...], str]:
    return predicate.name, predicate.types, _meaning(predicate)


def _meaning(predicate: Predicate) -> str:
    """The semantics without case, punctuation and the names of the parameters' types."""
    text = " ".join(re.findall(r"\w+", predicate.semantics.casefold()))
    for place, name in enumerate(predicate.types):
        spoken = " ".join(re.findall(r"\w+", name.casefold()))
        forms = {re.escape(spoken), re.escape(spoken.replace("_", " "))}
        text = re.sub(rf"\b(?:{'|'.join(sorted(forms))})\b", f"?{place}", text)
    return text

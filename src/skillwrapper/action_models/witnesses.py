"""Witnesses: states in which it is looked up whether a precondition makes a difference.

A failure never shows that something is *no* precondition: whoever asks for more is as consistent
with it. But what held in every state and with all objects for which the others held says nothing
of its own there, and a model without it applies in the same way wherever anything was seen.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.action_models.joins import Effort, Facts, Join, Literal
from skillwrapper.action_models.models import Condition
from skillwrapper.action_models.skeleton import DomainSkeleton, Schema, TypedName
from skillwrapper.action_models.steps import State, Step

_ENOUGH_STATES = 10
"""In so many states the other conditions must hold before anything is said to follow from them."""


_EFFORT = 100_000
"""So many partial bindings are looked at to answer one question."""

_Filled = set[tuple[str, TypedName]]
"""Objects, and parameters in whose place they stood."""


class SeenStates:
    """Keeps the first different states before steps, and what their arguments are.

    Args:
        most: how many states are kept.
    """

    def __init__(self, skeleton: DomainSkeleton, most: int) -> None:
        self._skeleton, self._most = skeleton, most
        self._states: dict[State, _Filled] = {}

    def add(self, step: Step) -> None:
        """Keep the state before, as long as there is room."""
        if len(self._states) < self._most:
            parameters = self._skeleton.actions[step.action].parameters
            filled = zip(step.arguments, parameters, strict=True)
            self._states.setdefault(step.before, set()).update(filled)

    def look(self) -> Witnesses:
        """The states so far, to be searched."""
        return Witnesses(self._skeleton, self._states)


class Witnesses:
    """States to be searched.

    Args:
        skeleton: the domain.
        states: the states, and what else is known of their objects.
    """

    def __init__(self, skeleton: DomainSkeleton, states: Mapping[State, _Filled]) -> None:
        self._skeleton, self._states = skeleton, states
        self._fitting: dict[tuple[str, ...], list[frozenset[str]]] = {}

    @cached_property
    def predicates(self) -> frozenset[str]:
        """The predicates of which anything is true."""
        return frozenset(atom.split(" ", 1)[0] for state in self._states for atom in state)

    def seen_by(self, action: Schema) -> list[Witness]:
        """The states as joins over the parameters of an action need them."""
        for parameter in action.parameters:
            if parameter.types not in self._fitting:
                self._fitting[parameter.types] = [*self._fit(parameter)]
        return [
            Witness(facts, {p.name: self._fitting[p.types][number] for p in action.parameters})
            for number, facts in enumerate(self._facts)
        ]

    def _fit(self, parameter: TypedName) -> Iterator[frozenset[str]]:
        """For every state the objects that may stand for a parameter, as far as is known."""
        slots = {slot for filled in self._slots for own in filled.values() for slot in own}
        may = {slot for slot in slots if self._overlap(slot, parameter)}
        for filled in self._slots:
            yield frozenset(
                name
                for name, own in filled.items()
                if may.issuperset(self._anywhere.get(name, own))
            )

    def _overlap(self, first: TypedName, second: TypedName) -> bool:
        """Whether one thing may stand in both places."""
        return self._skeleton.fits(first, second) or self._skeleton.fits(second, first)

    @cached_property
    def _anywhere(self) -> dict[str, set[TypedName]]:
        """The places in which objects stand in any state; not of names of different things."""
        found: dict[str, set[TypedName]] = {}
        for filled in self._slots:
            for name, slots in filled.items():
                found.setdefault(name, set()).update(slots)
        return {
            name: slots
            for name, slots in found.items()
            if all(self._overlap(a, b) for a, b in itertools.combinations(slots, 2))
        }

    @cached_property
    def _facts(self) -> list[Facts]:
        return [Facts(state) for state in self._states]

    @cached_property
    def _slots(self) -> list[dict[str, set[TypedName]]]:
        """For every state its objects and the places in which they stand."""
        return [self._filled(state, given) for state, given in self._states.items()]

    def _filled(self, state: State, given: _Filled) -> dict[str, set[TypedName]]:
        found = {constant.name: {constant} for constant in self._skeleton.constants}
        for name, slot in given:
            found.setdefault(name, set()).add(slot)
        for atom in state:
            predicate, *terms = atom.split(" ")
            slots = self._skeleton.predicates[predicate].parameters
            for name, slot in zip(terms, slots, strict=True):
                found.setdefault(name, set()).add(slot)
        return found


@dataclass(frozen=True, eq=False)
class Witness:
    """A state, seen from an action.

    Attributes:
        facts: what is true.
        allowed: which objects may stand for every parameter.
    """

    facts: Facts
    allowed: Mapping[str, frozenset[str]]

    def satisfies(self, action: Schema, literals: Sequence[Literal], effort: Effort) -> bool:
        """Whether literals hold for some objects in the place of an action's parameters."""
        join = Join(action.parameters, literals, self.facts, self.allowed, effort)
        return next(join.bindings(), None) is not None


def makes_no_difference(
    condition: Condition, others: Iterable[Condition], action: Schema, seen: Sequence[Witness]
) -> bool:
    """Whether a condition held in every state, with all objects for which others did.

    Where the others hold in too few states this is no more than chance, and the answer is no; so
    it is if the search takes too long.
    """
    others = list(others)
    if not never_came_about(condition, others, action, seen):
        return False
    asked, effort = [_literal(c) for c in others], Effort(_EFFORT)
    held = (w for w in seen if w.satisfies(action, asked, effort))
    return sum(1 for _ in itertools.islice(held, _ENOUGH_STATES)) == _ENOUGH_STATES


def never_came_about(
    condition: Condition, others: Iterable[Condition], action: Schema, seen: Sequence[Witness]
) -> bool:
    """Whether in no state, with no objects, a condition was violated while others held.

    No, if the search takes too long.
    """
    against = [_literal(c) for c in (*others, Condition(condition.atom, not condition.holds))]
    effort = Effort(_EFFORT)
    came_about = any(w.satisfies(action, against, effort) for w in seen)
    return not came_about and effort.left >= 0


def _literal(condition: Condition) -> Literal:
    return condition.holds, (condition.atom.predicate, *condition.atom.terms)

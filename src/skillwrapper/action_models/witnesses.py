"""Witnesses: states in which it is looked up whether a precondition makes a difference.

A failure never shows that something is *no* precondition: whoever asks for more is as consistent
with it. But what held in every state and with all objects for which the others held says nothing
of its own there, and a model without it applies in the same way wherever anything was seen.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from skillwrapper.action_models.joins import Facts, Join, Literal
from skillwrapper.action_models.models import Condition
from skillwrapper.action_models.skeleton import DomainSkeleton, Schema, TypedName
from skillwrapper.action_models.steps import State, Step

_ENOUGH_STATES = 10
"""In so many states the other conditions must hold before anything is said to follow from them."""


class Witnesses:
    """Keeps the first different states of all steps, and what kinds their objects are of.

    Args:
        skeleton: the domain.
        most: how many states are kept.
    """

    def __init__(self, skeleton: DomainSkeleton, most: int) -> None:
        self._skeleton, self._most = skeleton, most
        self._states: dict[State, dict[str, set[TypedName]]] = {}

    def add(self, step: Step) -> None:
        """Keep the state before, as long as there is room, and what the arguments are."""
        if step.before not in self._states:
            if len(self._states) >= self._most:
                return
            self._states[step.before] = self._kinds(step.before)
        action = self._skeleton.actions[step.action]
        for name, slot in zip(step.arguments, action.parameters, strict=True):
            self._states[step.before].setdefault(name, set()).add(slot)

    @property
    def predicates(self) -> frozenset[str]:
        """The predicates of which anything is true in a state that was kept."""
        return frozenset(atom.split(" ", 1)[0] for state in self._states for atom in state)

    def _kinds(self, state: State) -> dict[str, set[TypedName]]:
        """The slots that objects fill in a state."""
        found: dict[str, set[TypedName]] = defaultdict(set)
        for constant in self._skeleton.constants:
            found[constant.name].add(constant)
        for atom in state:
            words = atom.split(" ")
            slots = self._skeleton.predicates[words[0]].parameters
            for name, slot in zip(words[1:], slots, strict=True):
                found[name].add(slot)
        return found

    def seen_by(self, action: Schema) -> list[Witness]:
        """The states as joins over the parameters of an action need them."""
        fits = {
            (slot, parameter): self._skeleton.fits(slot, parameter)
            for kinds in self._states.values()
            for slot in set().union(*kinds.values())
            for parameter in action.parameters
        }
        return [
            Witness(
                Facts(state),
                {
                    p.name: frozenset(n for n, own in kinds.items() if any(fits[s, p] for s in own))
                    for p in action.parameters
                },
            )
            for state, kinds in self._states.items()
        ]


@dataclass(frozen=True, eq=False)
class Witness:
    """A state, seen from an action.

    Attributes:
        facts: what is true.
        allowed: which objects may stand for every parameter.
    """

    facts: Facts
    allowed: Mapping[str, frozenset[str]]

    def satisfies(self, action: Schema, literals: Sequence[Literal]) -> bool:
        """Whether literals hold for some objects in the place of an action's parameters."""
        found = Join(action.parameters, literals, self.facts, self.allowed).bindings()
        return next(iter(found), None) is not None


def makes_no_difference(
    condition: Condition, others: Iterable[Condition], action: Schema, seen: Sequence[Witness]
) -> bool:
    """Whether a condition held in every state, with all objects for which others did.

    Where the others hold in too few states this is no more than chance, and the answer is no.
    """
    asked = [_literal(c) for c in others]
    against = [*asked, _literal(Condition(condition.atom, not condition.holds))]
    if any(w.satisfies(action, against) for w in seen):
        return False
    held = (w for w in seen if w.satisfies(action, asked))
    return sum(1 for _ in itertools.islice(held, _ENOUGH_STATES)) == _ENOUGH_STATES


def _literal(condition: Condition) -> Literal:
    return condition.holds, (condition.atom.predicate, *condition.atom.terms)

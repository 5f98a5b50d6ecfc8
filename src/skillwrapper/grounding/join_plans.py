"""In which order the parameters of an operator are bound, and what can then be looked at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding.atom_index import AtomPatterns
from skillwrapper.grounding.atom_space import FALSE, TRUE, Labels
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.symbols import Atom


@dataclass(frozen=True)
class JoinStep:
    """The next parameter to bind.

    Attributes:
        bound: the positions that are bound before.
        position: of the parameter; of no meaning for what is bound beforehand.
        patterns: of the literals that can then be looked at.
        wanted: the labels (literals,) that they ask for.
        changed: of the changed atoms that can then be looked at.
        becomes: what each of them becomes (atoms,): TRUE or FALSE.
    """

    bound: list[int]
    position: int
    patterns: AtomPatterns
    wanted: Labels
    changed: AtomPatterns
    becomes: Labels

    @classmethod
    def of(
        cls, operator: IndexedOperator, bound: Sequence[int], new: Sequence[int], *, first: bool
    ) -> JoinStep:
        """What can be looked at with some parameters newly bound; nullary atoms at first."""
        names = [v.name for v in operator.operator.parameters]
        all_bound = {names[n] for n in (*bound, *new)}
        fresh = {names[n] for n in new}

        def is_due(atom: Atom) -> bool:
            return all_bound.issuperset(atom.terms) and (first or bool(fresh & {*atom.terms}))

        literals = [x for x in operator.literals if is_due(x.atom)]
        changes = [x for x in operator.changes if is_due(x.atom)]
        return cls(
            bound=list(bound),
            position=new[0] if new else 0,
            patterns=operator.patterns(x.atom for x in literals),
            wanted=np.array([TRUE if x.positive else FALSE for x in literals], dtype=np.int8),
            changed=operator.patterns(x.atom for x in changes),
            becomes=np.array([TRUE if x.positive else FALSE for x in changes], dtype=np.int8),
        )


@dataclass(frozen=True)
class JoinPlan:
    """How an operator is joined with objects.

    Attributes:
        first: what can be looked at beforehand.
        steps: one for every further parameter.
    """

    first: JoinStep
    steps: tuple[JoinStep, ...]

    @classmethod
    def of(cls, operator: IndexedOperator, given: int, *, by_change: bool) -> JoinPlan:
        """The plan for an operator of which some parameters are bound beforehand.

        Args:
            operator: the operator.
            given: how many.
            by_change: whether its changes are looked at too, and not its conditions alone.
        """
        known, order = list(range(given)), _order(operator, given, by_change=by_change)
        return cls(
            JoinStep.of(operator, [], known, first=True),
            tuple(
                JoinStep.of(operator, [*known, *order[:number]], [position], first=False)
                for number, position in enumerate(order)
            ),
        )

    @property
    def widest(self) -> int:
        """At most so many labels of a binding are looked at in one step."""
        return max(len(s.wanted) + len(s.becomes) for s in (self.first, *self.steps))


def _order(operator: IndexedOperator, given: int, *, by_change: bool) -> list[int]:
    """The further parameters; next comes the one that is tied most closely to those before it."""
    names = [v.name for v in operator.operator.parameters]
    bound, left = set(names[:given]), list(range(given, len(names)))
    ties = [set(x.atom.terms) for x in operator.literals if x.positive]
    ties += [set(x.atom.terms) for x in operator.changes] if by_change else []
    order: list[int] = []

    def looseness(position: int) -> tuple[int, int, int]:
        name = names[position]
        own = [terms for terms in ties if name in terms and terms <= {*bound, name}]
        return -sum(len(t) > 1 for t in own), -len(own), int(operator.allowed[position].sum())

    while left:
        position = min(left, key=looseness)
        left.remove(position)
        order.append(position)
        bound.add(names[position])
    return order

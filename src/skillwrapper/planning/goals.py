"""Goals: what must hold at the end, from an expression or from an abstract state."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from skillwrapper.errors import GoalError
from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.planning.goal_formulas import alternatives
from skillwrapper.planning.goal_reader import GoalReader
from skillwrapper.symbols.predicates import Literal


@dataclass(frozen=True)
class Goal:
    """A goal over the ground atoms of a scene.

    Attributes:
        alternatives: sets of ground literals; the goal holds where all of one of them hold.
    """

    alternatives: tuple[frozenset[Literal], ...]

    @classmethod
    def all_of(cls, literals: Iterable[Literal]) -> Goal:
        """The goal that all of some literals hold."""
        return cls((frozenset(literals),))

    def holds(self, space: AtomSpace, state: Labels) -> bool:
        """Whether it holds in an abstract state (shape: atoms); unknown counts as false."""
        return any(
            all((state[space.column[x.atom]] == TRUE) == x.positive for x in literals)
            for literals in self.alternatives
        )

    def together_with(self, other: Goal) -> Goal:
        """The goal that both hold.

        Raises:
            GoalError: if they contradict each other.
        """
        pairs = (a | b for a in self.alternatives for b in other.alternatives)
        possible = tuple(dict.fromkeys(x for x in pairs if len({y.atom for y in x}) == len(x)))
        if not possible:
            raise GoalError(f"goal: '{self}' and '{other}' cannot hold together; leave one out")
        return Goal(possible)

    def __str__(self) -> str:
        return ", or ".join(" and ".join(map(str, sorted(a))) for a in self.alternatives)


def parse_goal(text: str, space: AtomSpace, types: Iterable[str] = ()) -> Goal:
    """Read a goal in PDDL's style or in that of functions.

    ``(and (is_open drawer) (not (holding robot cup)))`` and
    ``is_open(drawer), not holding(robot, cup)`` are the same goal. There may be comments,
    ``or``, ``imply``, ``=``, and ``forall`` and ``exists`` over the objects of the scene;
    keywords in any case.

    Args:
        text: the expression.
        space: the ground atoms of the scene.
        types: declared types, for quantifiers over one that no object of the scene has.

    Raises:
        GoalError: if it is no goal, or an atom has arguments of the wrong number or types.
        UnknownNameError: if there is no such predicate, object or type.
    """
    return Goal(alternatives(GoalReader(space, types).read(text), space))


def goal_from_state(space: AtomSpace, state: Labels, *, positive_only: bool = False) -> Goal:
    """What is known of an abstract state (docs/semantics.md, D12).

    Args:
        space: the ground atoms.
        state: TRUE, FALSE or UNKNOWN for every atom (shape: atoms).
        positive_only: leave out what is false, as the paper does.
    """
    chosen = state == TRUE if positive_only else state != UNKNOWN
    return Goal.all_of(
        Literal(space.atoms[i], bool(state[i] == TRUE)) for i in np.flatnonzero(chosen)
    )

"""What is bound: skill instances attempted in abstract states, and operators bound to them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.atom_index import Columns
from skillwrapper.grounding.atom_space import FALSE, TRUE, UNKNOWN, Labels
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.world.skills import SkillInstance

UNCHANGED = 2
"""Stands for no label; no effect and no condition asks for it."""


@dataclass(frozen=True, eq=False)
class Attempts:
    """Skill instances of one skill, each looked at in some abstract states.

    Attributes:
        states: the abstract states.
        arguments: numbers of the objects (instances, arguments) of every skill instance; or of
            all objects that are bound beforehand, which may be more than the arguments.
        rows: the state (attempts,) of every attempt.
        which: the skill instance (attempts,) of every attempt.
        changes: what each atom became in a state: TRUE, FALSE, UNKNOWN or ``UNCHANGED``. If given,
            an operator is only bound so that its plain effects are part of it.
    """

    states: AbstractStates
    arguments: Columns
    rows: NDArray[np.intp]
    which: NDArray[np.intp]
    changes: AbstractStates | None = None

    @classmethod
    def everywhere(cls, states: AbstractStates, arguments: Columns) -> Attempts:
        """Every skill instance in every state, state by state."""
        rows = np.repeat(np.arange(len(states)), len(arguments))
        which = np.tile(np.arange(len(arguments)), len(states))
        return cls(states, arguments, rows, which)

    @classmethod
    def unbound(cls, states: AbstractStates) -> Attempts:
        """Whatever skill instance, in every state."""
        return cls.everywhere(states, np.zeros((1, 0), dtype=np.intp))

    def __len__(self) -> int:
        return len(self.rows)


@dataclass(frozen=True, eq=False)
class Bindings:
    """Bindings of one operator, each of an attempt.

    Attributes:
        operator: the operator.
        attempts: what was attempted.
        attempt: the attempt (bindings,) of every binding.
        objects: the numbers (bindings, parameters) of the objects.
        unmet: how many conditions (bindings,) are surely unmet.
        unsure: whether a condition (bindings,) hangs on an unknown label.
    """

    operator: IndexedOperator
    attempts: Attempts
    attempt: NDArray[np.intp]
    objects: Columns
    unmet: NDArray[np.intp]
    unsure: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.attempt)

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp] | slice) -> Bindings:
        """Those that a mask (bindings,), places or a slice name."""
        return Bindings(
            self.operator,
            self.attempts,
            self.attempt[chosen],
            self.objects[chosen],
            self.unmet[chosen],
            self.unsure[chosen],
        )

    @property
    def rows(self) -> NDArray[np.intp]:
        """The state (bindings,) of every binding."""
        return self.attempts.rows[self.attempt]

    @property
    def which(self) -> NDArray[np.intp]:
        """The number (bindings,) of the skill instance of every binding."""
        return self.attempts.which[self.attempt]

    @property
    def instances(self) -> list[SkillInstance]:
        """The skill instance (bindings,) of every binding."""
        operator, names = self.operator.operator, self.operator.space.objects
        return [
            SkillInstance(operator.skill, tuple(names[number].name for number in own))
            for own in self.objects[:, : operator.arity].tolist()
        ]

    @property
    def applicability(self) -> Labels:
        """Whether the operator applies (bindings,): TRUE, FALSE or UNKNOWN in Kleene's logic."""
        possible = np.where(self.unsure, UNKNOWN, TRUE)
        return np.where(self.unmet > 0, FALSE, possible).astype(np.int8)

    @property
    def sure(self) -> Bindings:
        """Those that surely apply."""
        return self.select((self.unmet == 0) & ~self.unsure)

    def met(self) -> Labels:
        """Whether each condition is met (bindings, conditions): TRUE, FALSE or UNKNOWN."""
        return self.operator.met(self.attempts.states, self.rows, self.objects)

    def effects(self) -> Labels:
        """The effects (bindings, atoms): 1 added, -1 deleted, 0 neither."""
        return self.operator.effects(self.attempts.states, self.rows, self.objects)

    def successors(self) -> Labels:
        """The next states (bindings, atoms), whether applicable or not."""
        return self.operator.successors(self.attempts.states, self.rows, self.objects)

"""Traces of which not every state is known: plans, and states of which a part was seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from skillwrapper.action_models.steps import State, Step

_NOTHING: State = frozenset()


@dataclass(frozen=True)
class PartialState:
    """What is known of a state.

    Attributes:
        true: atoms that are true.
        false: atoms that are false; None if all others are.
    """

    true: State = _NOTHING
    false: State | None = _NOTHING

    @property
    def is_complete(self) -> bool:
        """Whether everything is known."""
        return self.false is None

    @property
    def atoms(self) -> State:
        """The atoms that it speaks of."""
        return self.true | (self.false or _NOTHING)

    def holds(self, atom: str) -> bool | None:
        """Whether an atom is true; None if that is unknown."""
        if atom in self.true:
            return True
        return False if self.false is None or atom in self.false else None


UNKNOWN = PartialState()
"""A state of which nothing is known."""


@dataclass(frozen=True)
class Attempt:
    """An action that was tried, without its states.

    Attributes:
        action: its name.
        arguments: names of the objects; one may occur twice.
        success: whether it was applicable.
        where: where it stands, for complaints.
    """

    action: str
    arguments: tuple[str, ...]
    success: bool = True
    where: str = ""


@dataclass(frozen=True)
class PartialTrace:
    """Attempts one after the other, and what is known of the states around them.

    Attributes:
        attempts: what was tried, in order.
        states: before the first, between them, and after the last.
    """

    attempts: tuple[Attempt, ...]
    states: tuple[PartialState, ...]


Evidence = Step | PartialTrace
"""What action models are learned from."""


@dataclass
class TraceBuilder:
    """Puts together what a file says in turn, and gives it out as soon as a state is complete.

    What lies between two complete states with one attempt between them is a step.
    """

    _attempts: list[Attempt] = field(default_factory=list)
    _states: list[PartialState] = field(default_factory=list)

    @property
    def is_empty(self) -> bool:
        """Whether there was no state yet."""
        return not self._states

    @property
    def waits(self) -> bool:
        """Whether the last thing was an attempt."""
        return len(self._attempts) == len(self._states) > 0

    def attempt(self, attempt: Attempt) -> None:
        """An attempt follows; of the state before it nothing is known if none came."""
        if self.waits:
            self._states.append(UNKNOWN)
        self._attempts.append(attempt)

    def state(self, state: PartialState) -> Sequence[Evidence]:
        """A state follows, after an attempt or as the first of all."""
        self._states.append(state)
        return self.end() if state.is_complete else ()

    def end(self) -> Sequence[Evidence]:
        """What there is by now; the last state begins what follows."""
        attempts, states = self._attempts, self._states
        self._attempts, self._states = [], states[-1:]
        if not attempts:
            return ()
        if len(attempts) > 1 or not (states[0].is_complete and states[-1].is_complete):
            return (PartialTrace(tuple(attempts), tuple(states)),)
        one = attempts[0]
        before, after = states[0].true, states[-1].true
        return (Step(one.action, one.arguments, one.success, before, after, one.where),)

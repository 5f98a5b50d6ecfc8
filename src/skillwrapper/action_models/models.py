"""Action models: what is learned from traces."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skillwrapper.action_models.skeleton import DomainSkeleton, LiftedAtom, Schema


@dataclass(frozen=True, order=True)
class Condition:
    """A literal over an action's parameters.

    Attributes:
        atom: the atom; of the predicate ``=`` for "are the same object".
        holds: whether it must be true, or must be false.
    """

    atom: LiftedAtom
    holds: bool = True

    def __str__(self) -> str:
        return str(self.atom) if self.holds else f"(not {self.atom})"


@dataclass(frozen=True, order=True)
class Effect:
    """What an action makes true or false.

    Attributes:
        change: what holds after; of an atom that is both added and deleted because two parameters
            stand for one object, the addition counts.
        when: only if all this held before; empty for always.
    """

    change: Condition
    when: tuple[Condition, ...] = ()


@dataclass(frozen=True)
class ActionModel:
    """When an action works, and what it does.

    Attributes:
        action: its name and parameters.
        preconditions: what must hold; sorted.
        effects: what changes; sorted.
        refuted: conditions that always held, and that failures speak against (sorted).
        steps: from how many transitions it was learned.
        unexplained: how many of these changed something that is not about the arguments; and, of
            those that look different, failed although everything that ever held was true, or ended
            otherwise than the effects say.
        undecided: of what no state shows whether the action changes it: no effect is said, and
            there may be one; sorted. Only where states were missing.
        unseen: of what no state before a success shows anything: whether there is a precondition
            about it is open; sorted. Only where states were missing.
    """

    action: Schema
    preconditions: tuple[Condition, ...]
    effects: tuple[Effect, ...]
    refuted: tuple[Condition, ...] = ()
    steps: int = 0
    unexplained: int = 0
    undecided: tuple[LiftedAtom, ...] = ()
    unseen: tuple[LiftedAtom, ...] = ()


@dataclass(frozen=True)
class DomainModel:
    """A learned planning domain.

    Attributes:
        skeleton: types, constants, predicates, and the parameters of all actions.
        actions: the actions that were seen to work, by name.
    """

    skeleton: DomainSkeleton
    actions: Mapping[str, ActionModel]

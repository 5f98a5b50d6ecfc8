"""Ground operators one by one, as planner files need them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.atom_index import Columns
from skillwrapper.grounding.atom_space import FALSE, TRUE, UNKNOWN, Labels
from skillwrapper.grounding.bindings import Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings
from skillwrapper.grounding.models import GroundModel
from skillwrapper.symbols.operators import Operator
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class GroundConditionalEffect:
    """One object's share of a conditional effect: columns that must hold, column that changes."""

    required_true: tuple[int, ...]
    required_false: tuple[int, ...]
    column: int
    becomes: int


@dataclass(frozen=True)
class GroundOperator:
    """An operator with objects for its parameters (the paper's abstract action).

    Attributes:
        indexed: the operator over the atoms of the scene.
        numbers: the numbers of the objects.
        required_true: columns that must be true.
        required_false: columns that must be false.
        added: columns that become true.
        deleted: columns that become false.
        conditional: conditional changes.
    """

    indexed: IndexedOperator = field(repr=False)
    numbers: tuple[int, ...]
    required_true: tuple[int, ...]
    required_false: tuple[int, ...]
    added: tuple[int, ...]
    deleted: tuple[int, ...]
    conditional: tuple[GroundConditionalEffect, ...] = ()

    @property
    def operator(self) -> Operator:
        """The lifted operator."""
        return self.indexed.operator

    @property
    def arguments(self) -> tuple[str, ...]:
        """The names of the objects."""
        return tuple(self.indexed.space.objects[number].name for number in self.numbers)

    @property
    def instance(self) -> SkillInstance:
        """The skill instance it belongs to."""
        return SkillInstance(self.operator.skill, self.arguments[: self.operator.arity])


def reachable_operators(model: GroundModel, start: Labels) -> tuple[GroundOperator, ...]:
    """The ground operators that may ever apply after a start (atoms,), each change once.

    That is judged by labels that only ever grow vaguer: what some operator may change is unknown
    from then on. All other ground operators can be left out of a planning problem.
    """
    possible, found = start.copy(), list(model.bind_all(start[np.newaxis]))
    while True:
        vaguer = possible.copy()
        for bindings in found:
            added, deleted = bindings.operator.possible_changes(bindings.objects)
            vaguer[added[possible[added] == FALSE]] = UNKNOWN
            vaguer[deleted[possible[deleted] == TRUE]] = UNKNOWN
        if (vaguer == possible).all():
            break
        possible, found = vaguer, list(model.bind_all(vaguer[np.newaxis]))
    different: dict[object, GroundOperator] = {}
    for ground in (g for bindings in found for g in _ground(bindings)):
        columns = ground.required_true, ground.required_false, ground.added, ground.deleted
        different.setdefault((ground.instance, columns, ground.conditional), ground)
    return tuple(different.values())


def follow(operators: Iterable[GroundOperator], start: Labels) -> Labels | None:
    """The abstract state (atoms,) that ground operators lead to, one after the other.

    Returns:
        None if one of them does not surely apply where it is reached.
    """
    state = start
    for ground in operators:
        numbers = np.array([ground.numbers], dtype=np.intp)
        attempts = Attempts.everywhere(AbstractStates(state[np.newaxis]), numbers)
        sure = [bindings.sure for bindings in find_bindings(ground.indexed, attempts)]
        if not any(map(len, sure)):
            return None
        state = sure[0].successors()[0]
    return state


def _ground(bindings: Bindings) -> Iterator[GroundOperator]:
    indexed, objects = bindings.operator, bindings.objects
    required = indexed.space.index.columns(indexed.literal_patterns, objects)
    absences = sorted(indexed.operator.absences)
    absent = np.hstack([required[:, :0], *(indexed.absent_columns(a, objects) for a in absences)])
    added, deleted = indexed.changed_columns(objects)
    conditional = _conditional(indexed, objects)
    positive = indexed.wanted == TRUE
    for number in np.lexsort(objects.T[::-1]) if objects.size else range(len(objects)):
        true = _distinct(required[number, positive])
        false = _distinct(required[number, ~positive], absent[number])
        if not set(true) & set(false):
            yield GroundOperator(
                indexed,
                tuple(objects[number].tolist()),
                true,
                false,
                _distinct(added[number]),
                _distinct(deleted[number]),
                tuple(conditional[number]),
            )


def _distinct(*columns: Columns) -> tuple[int, ...]:
    """Sorted, without what is no grounding, which is false in every state."""
    return tuple(sorted({int(c) for own in columns for c in own if c >= 0}))


def _conditional(indexed: IndexedOperator, objects: Columns) -> list[list[GroundConditionalEffect]]:
    found: list[list[GroundConditionalEffect]] = [[] for _ in objects]
    for effect in sorted(indexed.operator.conditional_effects):
        condition, changed = indexed.condition_columns(effect, objects)
        positive = np.array([literal.positive for literal in effect.condition], dtype=bool)
        becomes = TRUE if effect.effect.positive else FALSE
        for number, other in np.argwhere(changed >= 0).tolist():
            own = condition[number, other]
            true, false = _distinct(own[positive]), _distinct(own[~positive])
            column = int(changed[number, other])
            found[number].append(GroundConditionalEffect(true, false, column, becomes))
    return found

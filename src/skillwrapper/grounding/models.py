"""The operators of a model over the objects of a scene, ready to meet abstract states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.atom_space import AtomSpace, Labels
from skillwrapper.grounding.bindings import Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Operator
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object


@dataclass(frozen=True)
class GroundModel:
    """All operators of a model over the objects of a scene.

    Attributes:
        space: the ground atoms.
        operators: the operators, in the order of the model.
    """

    space: AtomSpace
    operators: tuple[IndexedOperator, ...]

    @classmethod
    def of(cls, model: AbstractModel, objects: Sequence[Object]) -> GroundModel:
        """Ground a model over objects."""
        return cls.from_operators(model.operators, AtomSpace(model.predicates, tuple(objects)))

    @classmethod
    def from_operators(cls, operators: Iterable[Operator], space: AtomSpace) -> GroundModel:
        """Ground operators over an atom space."""
        return cls(space, tuple(IndexedOperator(operator, space) for operator in operators))

    @cached_property
    def by_skill(self) -> dict[str, tuple[IndexedOperator, ...]]:
        """The operators of every skill that has any."""
        found: dict[str, list[IndexedOperator]] = {}
        for operator in self.operators:
            found.setdefault(operator.operator.skill, []).append(operator)
        return {skill: tuple(operators) for skill, operators in found.items()}

    def bind(self, states: Labels, instances: Sequence[SkillInstance]) -> Iterator[Bindings]:
        """All bindings that may apply, of skill instances of one skill in every state.

        Args:
            states: abstract states (n, atoms).
            instances: of one skill, over the objects of the scene; ``Bindings.which`` are their
                places.
        """
        if not instances:
            return
        names = [self.space.index.numbers(instance.arguments) for instance in instances]
        arguments = np.array(names, dtype=np.intp).reshape(len(names), -1)
        attempts = Attempts.everywhere(AbstractStates(states), arguments)
        for operator in self.by_skill.get(instances[0].skill, ()):
            yield from find_bindings(operator, attempts)

    def bind_all(self, states: Labels) -> Iterator[Bindings]:
        """All bindings that may apply in every state (n, atoms), of whatever skill instance."""
        attempts = Attempts.unbound(AbstractStates(states))
        for operator in self.operators:
            yield from find_bindings(operator, attempts)

    def successors(self, states: Labels, instance: SkillInstance) -> Labels:
        """The different states that a skill instance surely leads to from some state.

        Args:
            states: abstract states (n, atoms).
            instance: the skill instance.
        """
        found = [bindings.sure.successors() for bindings in self.bind(states, [instance])]
        different = {row.tobytes(): row for after in found for row in after}
        return np.array(list(different.values()), dtype=np.int8).reshape(-1, states.shape[1])

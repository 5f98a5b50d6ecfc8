"""The two transitions of an inconsistency, as a candidate predicate alone shows them.

Only their pictures are looked at: a candidate that cannot tell them apart needs no other label.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.lifted_states import LiftedState, lifted_state
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Literal, Predicate
from skillwrapper.transitions.lifting import LiftedChange, lift_change
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.transitions.tables import changed_literals
from skillwrapper.world.observation import Observation


class Witnesses:
    """Tells whether candidates tell the transitions of an inconsistency apart.

    Args:
        recorded: the transitions.
        truth: labels their pictures.
        inconsistency: names two of them, or one with an unexplained change.
    """

    def __init__(
        self, recorded: RecordedTransitions, truth: TruthSource, inconsistency: Inconsistency
    ) -> None:
        self._truth = truth
        self._records = recorded.records
        self._inconsistency = inconsistency
        self._compares_changes = (
            inconsistency.second is None or inconsistency.kind is InconsistencyKind.EFFECT
        )

    def look(self, candidates: Sequence[Predicate]) -> None:
        """Have their pictures labelled for all candidates in one go."""
        numbers = (self._inconsistency.first, self._inconsistency.second)
        self._truth.prefetch(
            (AtomSpace(tuple(candidates), self._records[n].scene.objects), self._pictures(n))
            for n in numbers
            if n is not None and candidates
        )

    def are_told_apart(self, predicate: Predicate) -> bool:
        """Whether a candidate shows a difference, or the unexplained change."""
        first, second = self._inconsistency.first, self._inconsistency.second
        if second is None:
            if self._relates(first, predicate):
                return True
            terms = [literal.atom.terms for literal in self._changed(first, predicate)]
            things = self._things()
            return any(things.intersection(own) or not own for own in terms)
        if self._compares_changes:
            return self._lifted_change(first, predicate) != self._lifted_change(second, predicate)
        return self._start(first, predicate) != self._start(second, predicate)

    def _relates(self, number: int, predicate: Predicate) -> bool:
        """Whether a relation ties what changed unexplained to an argument, unchanged."""
        if self._inconsistency.kind is not InconsistencyKind.UNEXPLAINED:
            return False
        space, labels = self._labels(number, predicate)
        arguments = set(self._records[number].transition.instance.arguments)
        things = self._things() - arguments
        held = (space.atoms[i] for i in np.flatnonzero(labels[0] == TRUE))
        return any(things & set(a.terms) and arguments & set(a.terms) for a in held)

    def _things(self) -> set[str]:
        """The objects about which something must have changed."""
        if self._inconsistency.kind is InconsistencyKind.UNNOTICED:
            number = self._inconsistency.first
            record = self._records[number]
            wide = self._inconsistency.wide
            return set(record.scene.names if wide else record.transition.instance.arguments)
        return {term for atom in self._inconsistency.unexplained for term in atom.terms}

    def _pictures(self, number: int) -> list[Observation]:
        """The pictures that matter: before, and after if changes are compared."""
        record = self._records[number]
        before, after = record.transition.before, record.transition.after
        if not self._compares_changes:
            return [before]
        since = self._inconsistency.since
        earlier = before if since is None else self._records[since].transition.before
        return [earlier, before if record.unchanged else after]

    def _labels(self, number: int, predicate: Predicate) -> tuple[AtomSpace, Labels]:
        space = AtomSpace((predicate,), self._records[number].scene.objects)
        return space, self._truth.labels(space, self._pictures(number))

    def _start(self, number: int, predicate: Predicate) -> LiftedState:
        space, labels = self._labels(number, predicate)
        return lifted_state(space, labels[0], self._records[number].transition.instance)

    def _lifted_change(self, number: int, predicate: Predicate) -> LiftedChange:
        """The change around the arguments."""
        arguments = self._records[number].transition.instance.arguments
        return lift_change(self._changed(number, predicate), arguments).change

    def _changed(self, number: int, predicate: Predicate) -> list[Literal]:
        """What is known to have changed."""
        space, labels = self._labels(number, predicate)
        change: Labels = (labels[1] - labels[0]) * (labels != UNKNOWN).all(axis=0)
        return changed_literals(space, change)

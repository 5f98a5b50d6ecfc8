"""From an inconsistency in the data to a question for a model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from skillwrapper.invention.questions import InventionAnswer, InventionQuestion
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions


class Adviser(Protocol):
    """Who is asked; ``vlm.assistant.Assistant`` is one."""

    def invent_predicates(self, question: InventionQuestion) -> InventionAnswer:
        """Candidates for a missing predicate."""
        ...


class ModelProposer:
    """Asks a model for predicates, with the pictures of the two transitions.

    Args:
        recorded: where the transitions stand.
        adviser: who is asked.
        count: how many candidates are wanted at once.
    """

    def __init__(self, recorded: RecordedTransitions, adviser: Adviser, count: int) -> None:
        self._recorded = recorded
        self._adviser = adviser
        self._count = count

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> Sequence[Predicate]:
        """Candidates that may tell the two transitions apart; may be empty."""
        records = self._recorded.records
        second = inconsistency.second
        question = InventionQuestion(
            domain=self._recorded.domain,
            skill=self._recorded.domain.skill_by_name[inconsistency.skill],
            kind=inconsistency.kind,
            first=records[inconsistency.first].transition,
            second=None if second is None else records[second].transition,
            types=self._types(inconsistency),
            unexplained=inconsistency.unexplained,
            current=tuple(current),
            rejected=tuple(rejected),
            count=self._count,
            attempt=attempt,
        )
        return self._adviser.invent_predicates(question).predicates

    def _types(self, inconsistency: Inconsistency) -> tuple[str, ...]:
        """The skill's types; for an unexplained change also those of its objects (D1)."""
        domain = self._recorded.domain
        skill = domain.skill_by_name[inconsistency.skill]
        types = dict.fromkeys(p.type for p in skill.parameters)
        if inconsistency.kind == InconsistencyKind.UNEXPLAINED:
            for atom in inconsistency.unexplained:
                for term in atom.terms:
                    types.update(dict.fromkeys(domain.object_by_name[term].types))
        return tuple(types)

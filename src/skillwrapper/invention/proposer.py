"""From an inconsistency in the data to a question for a model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Protocol

from skillwrapper.invention.questions import (
    InventionAnswer,
    InventionQuestion,
    RephrasingQuestion,
)
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.shaping import lift, widen
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions


class Adviser(Protocol):
    """Who is asked; ``vlm.assistant.Assistant`` is one."""

    def invent_predicates(self, question: InventionQuestion) -> InventionAnswer:
        """Candidates for a missing predicate."""
        ...

    def rephrase_predicate(self, question: RephrasingQuestion) -> InventionAnswer:
        """A candidate in general terms."""
        ...


class ModelProposer:
    """Asks a model for predicates, with the pictures of the two transitions.

    Args:
        recorded: where the transitions stand.
        adviser: who is asked.
        settings: how many candidates are wanted at once, and in what form they are judged.
    """

    def __init__(
        self, recorded: RecordedTransitions, adviser: Adviser, settings: LearningSettings
    ) -> None:
        self._recorded = recorded
        self._adviser = adviser
        self._settings = settings
        self._rephrased: dict[Predicate, Predicate] = {}

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> Sequence[Predicate]:
        """Candidates that may tell the two transitions apart; may be empty."""
        records = self._recorded.records
        second, since = inconsistency.second, inconsistency.since
        first = records[inconsistency.first].transition
        if since is not None:
            first = replace(first, before=records[since].transition.before)
        question = InventionQuestion(
            domain=self._recorded.domain,
            skill=self._recorded.domain.skill_by_name[inconsistency.skill],
            kind=inconsistency.kind,
            first=first,
            second=None if second is None else records[second].transition,
            types=self._types(inconsistency),
            unexplained=inconsistency.unexplained,
            current=tuple(current),
            rejected=tuple(rejected),
            count=self._settings.candidates,
            attempt=attempt,
            wide=inconsistency.wide,
            long=since is not None,
        )
        found = self._adviser.invent_predicates(question).predicates
        return tuple(dict.fromkeys(shaped for p in found for shaped in self._shaped(p)))

    def _shaped(self, predicate: Predicate) -> Iterator[Predicate]:
        """The candidate in its most general form (D8); nothing if it hides a constant for good."""
        domain = self._recorded.domain
        shaped = lift(predicate, domain) if self._settings.lift else predicate
        if shaped is not None:
            if self._settings.rephrase and shaped.arity > predicate.arity:
                shaped = self._rephrase(predicate, shaped)
            yield widen(shaped, domain) if self._settings.widen else shaped

    def _rephrase(self, predicate: Predicate, lifted: Predicate) -> Predicate:
        """A lifted candidate in words of the model's; each is asked for only once."""
        if predicate not in self._rephrased:
            domain = self._recorded.domain
            question = RephrasingQuestion(domain, predicate, lifted.types)
            said = self._adviser.rephrase_predicate(question).predicates
            fitting = (p for p in said if p.types == lifted.types and lift(p, domain) == p)
            self._rephrased[predicate] = next(fitting, lifted)
        return self._rephrased[predicate]

    def _types(self, inconsistency: Inconsistency) -> tuple[str, ...]:
        """The skill's types; for an unexplained change also those of its objects (D1).

        For one of other objects than the arguments, those of all things that skills take.
        """
        domain = self._recorded.domain
        skill = domain.skill_by_name[inconsistency.skill]
        types = dict.fromkeys(p.type for p in skill.parameters)
        if inconsistency.kind == InconsistencyKind.UNEXPLAINED:
            for atom in inconsistency.unexplained:
                for term in atom.terms:
                    types.update(dict.fromkeys(domain.object_by_name[term].types))
        if inconsistency.wide:
            types.update(dict.fromkeys(p.type for s in domain.skills for p in s.parameters))
        return tuple(types)

"""Inventing a whole vocabulary in one go: the paper's baseline FM Invent."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.questions import BatchInventionQuestion, InventionAnswer
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.fitting import Fit
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


class BatchAdviser(Protocol):
    """Who is asked; ``vlm.assistant.Assistant`` is one."""

    def invent_batch(self, question: BatchInventionQuestion) -> InventionAnswer:
        """A whole vocabulary."""
        ...


class BatchInventor:
    """Asks once for all predicates, with every picture there is at that moment.

    Whatever comes is taken into use; no data decide about it. What pruning sets dormant after
    one iteration is taken into use again in the next, so that more data can bring it back.

    Args:
        fitter: learns operators, and holds the pictures.
        vocabulary: the predicates; changed in place.
        adviser: who is asked.
        count: how many predicates are wanted at most.
        listener: told of every predicate that is taken.
    """

    def __init__(
        self,
        fitter: Fitter,
        vocabulary: Vocabulary,
        adviser: BatchAdviser,
        count: int,
        listener: Callable[[CandidateDecision], None] = lambda decision: None,
    ) -> None:
        self._fitter = fitter
        self._vocabulary = vocabulary
        self._adviser = adviser
        self._count = count
        self._listener = listener
        self._asked = False

    def invent(self) -> Fit:
        """The vocabulary's fit; the first call fills the vocabulary."""
        for predicate in self._vocabulary.dormant:
            self._vocabulary.accept(predicate)
        if not self._asked:
            self._asked = True
            self._ask()
        return self._fitter.fit(self._vocabulary.active)

    def keep_up(self) -> Fit:
        """The vocabulary's fit; during an episode nothing is invented."""
        return self._fitter.fit(self._vocabulary.active)

    def note_start(self, scene: Scene, start: Observation) -> None:
        """Nothing is compared between starts."""

    def _ask(self) -> None:
        recorded = self._fitter.recorded
        observations = tuple(o for scene in recorded.scenes for o in recorded.observations(scene))
        question = BatchInventionQuestion(recorded.domain, observations, self._count)
        for predicate in self._vocabulary.fresh(self._adviser.invent_batch(question).predicates):
            self._vocabulary.accept(predicate)
            reason = "one of the batch"
            self._listener(CandidateDecision(Verdict.ACCEPTED, predicate, reason))

"""The truth table: labels of ground atoms in observations, read by a model, asked for only once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.observation import Observation
from skillwrapper.world.types import Object


class LabelProvider(Protocol):
    """Who says what is true in pictures; ``vlm.assistant.Assistant`` is one."""

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> Sequence[EvaluationAnswer]:
        """Answer all questions, in their order."""
        ...


class TruthTable:
    """Labels by scene, predicate (its meaning included) and picture; only what is missing is asked.

    Each observation with something missing is one question about all missing predicates; all
    questions of a call are independent and go out together.

    Attributes:
        question_sizes: how many questions were asked with so many groundings.
    """

    def __init__(self, domain: Domain, reader: LabelProvider) -> None:
        self._domain = domain
        self._reader = reader
        self._labels: dict[tuple[tuple[Object, ...], Predicate], dict[str, Labels]] = {}
        self._agreement: dict[Predicate, list[float]] = {}
        self.question_sizes: Counter[int] = Counter()

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Ask for everything that will be needed in one wave, and for each picture only once.

        What ``labels`` says afterwards is the same as without; it just need not wait.

        Raises:
            ProviderError: if the model does not answer.
        """
        questions: dict[tuple[tuple[Object, ...], str], EvaluationQuestion] = {}
        for space, observations in wanted:
            for question in self._missing(space, observations):
                key = (question.objects, question.observation.key)
                known = questions.get(key, question)
                both = dict.fromkeys((*known.predicates, *question.predicates))
                questions[key] = replace(question, predicates=tuple(both))
        self._ask(list(questions.values()))

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms): TRUE, FALSE or UNKNOWN.

        Raises:
            ProviderError: if the model does not answer.
        """
        self._ask(self._missing(space, observations))
        columns = [
            np.array([self._known(space.objects, p)[o.key] for o in observations], dtype=np.int8)
            for p in space.predicates
        ]
        shape = (len(observations), len(space.atoms))
        return np.hstack(columns) if columns and observations else np.zeros(shape, dtype=np.int8)

    def agreement(self, predicate: Predicate) -> float | None:
        """The share of votes for the label, on average over all labels read of a predicate.

        None if nothing was voted on.
        """
        shares = self._agreement.get(predicate)
        return sum(shares) / len(shares) if shares else None

    def _known(self, objects: tuple[Object, ...], predicate: Predicate) -> dict[str, Labels]:
        return self._labels.setdefault((objects, predicate), {})

    def _missing(
        self, space: AtomSpace, observations: Sequence[Observation]
    ) -> list[EvaluationQuestion]:
        """A question for each observation of which not all is known."""
        known = [(p, self._known(space.objects, p)) for p in space.predicates]
        questions = []
        for observation in {o.key: o for o in observations}.values():
            missing = tuple(p for p, rows in known if observation.key not in rows)
            if missing:
                questions.append(
                    EvaluationQuestion(self._domain, space.objects, observation, missing)
                )
        return questions

    def _ask(self, wanted: Sequence[EvaluationQuestion]) -> None:
        questions = [part for question in wanted for part in _without_namesakes(question)]
        if not questions:
            return
        answers = self._reader.evaluate(questions)
        for question, answer in zip(questions, answers, strict=True):
            groundings = 0
            for predicate in question.predicates:
                atoms = predicate.groundings(question.objects)
                groundings += len(atoms)
                known = self._known(question.objects, predicate)
                known[question.observation.key] = encode_labels(atoms, answer.labels)
                shares = [answer.agreement[atom] for atom in atoms if atom in answer.agreement]
                self._agreement.setdefault(predicate, []).extend(shares)
            self.question_sizes[groundings] += 1


def _without_namesakes(question: EvaluationQuestion) -> Iterator[EvaluationQuestion]:
    """The question in parts: answers name predicates, so no part may hold two of one name."""
    parts: list[dict[str, Predicate]] = []
    for predicate in question.predicates:
        for part in parts:
            if predicate.name not in part:
                part[predicate.name] = predicate
                break
        else:
            parts.append({predicate.name: predicate})
    for part in parts:
        yield replace(question, predicates=tuple(part.values()))


def encode_labels(atoms: Sequence[Atom], labels: Mapping[Atom, bool | None]) -> Labels:
    """Labels of atoms (atoms,) as an array; a missing one is UNKNOWN, never FALSE (D10)."""
    codes = {True: TRUE, False: FALSE, None: UNKNOWN}
    return np.array([codes[labels.get(atom)] for atom in atoms], dtype=np.int8)

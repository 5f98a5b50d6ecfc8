"""Evaluation: a free judgement of a picture, then, unless it is clear, a summary of that."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.symbols.predicates import Atom, Predicate, all_groundings
from skillwrapper.vlm.cut_offs import CUT_OFF_PROBLEM, CutOffs
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.parsing import parse_labels
from skillwrapper.vlm.parsing.names import fold
from skillwrapper.vlm.protocol import ModelRequest
from skillwrapper.vlm.requests import RequestBuilder
from skillwrapper.vlm.settings import AskingSettings
from skillwrapper.vlm.waves import run_wave
from skillwrapper.world.types import Object

_Labels = dict[Atom, bool | None]


@dataclass(frozen=True)
class _Task:
    """One vote on one batch of groundings of one question."""

    question: EvaluationQuestion
    atoms: tuple[Atom, ...]
    vote: int


class Evaluator:
    """Labels groundings.

    Args:
        models: the models; the roles ``evaluate`` and ``summarise`` are used.
        requests: renders the prompts.
        settings: batch size, calls in flight, votes, how often to ask again.
    """

    def __init__(
        self, models: ModelSet, requests: RequestBuilder, settings: AskingSettings
    ) -> None:
        self._models, self._requests, self._settings = models, requests, settings

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        """Answer all questions in one wave of calls."""
        tasks = [list(self._tasks(question)) for question in questions]
        wave = [task for mine in tasks for task in mine]
        results = iter(run_wave(self._label, wave, self._settings.parallel))
        return [self._answer(mine, results) for mine in tasks]

    def _tasks(self, question: EvaluationQuestion) -> Iterator[_Task]:
        atoms = _groundings(question.predicates, question.objects)
        size = self._settings.batch_size
        for start in range(0, len(atoms), size):
            for vote in range(self._settings.votes):
                yield _Task(question, atoms[start : start + size], vote)

    def _label(self, task: _Task) -> _Labels:
        """The labels of one task; what stays unanswered is unknown (docs/semantics.md D10)."""
        labels: _Labels = {}
        missing, problem = task.atoms, ""
        incomplete = unusable = 0
        cut_offs = CutOffs()
        while missing:
            found, cut_off = self._ask(task, missing, incomplete + unusable, problem, cut_offs)
            labels.update(found)
            incomplete, unusable = incomplete + bool(labels), unusable + (not labels)
            missing = tuple(atom for atom in missing if atom not in labels)
            unclear = f"no clear judgement on {', '.join(map(str, missing[:3]))}"
            problem = CUT_OFF_PROBLEM if cut_off else unclear
            if incomplete > self._settings.reasks or unusable > self._settings.unusable_reasks:
                break
        return {atom: labels.get(atom) for atom in task.atoms}

    def _ask(
        self, task: _Task, atoms: tuple[Atom, ...], time: int, problem: str, cut_offs: CutOffs
    ) -> tuple[Mapping[Atom, bool | None], bool]:
        """Both stages once: the labels that were found, and whether a reply was cut off.

        There are none if the replies are of no use.
        """
        repetition = task.vote * self._settings.most_repetitions + time
        judging = self._again(self._requests.evaluation(task.question, atoms), problem, time)
        judging = replace(judging, repetition=repetition)
        free = self._models.complete(judging)
        cut_off = cut_offs.check(self._models.by_role[judging.role], judging, free)
        if cut_off or free.taken_back or not _speaks_of_scene(free.answer, task.question):
            self._models.take_back(judging)
            return {}, cut_off
        labels = self._read_directly(free.answer, atoms)
        if labels:
            return labels, False
        summing = self._requests.summary(task.question, atoms, free.answer)
        summing = replace(self._again(summing, problem, time), repetition=repetition)
        labels, cut_off = self._sum_up(summing, atoms, cut_offs)
        if not labels:
            self._models.take_back(judging)
        return labels, cut_off

    def _read_directly(self, judgement: str, atoms: tuple[Atom, ...]) -> Mapping[Atom, bool | None]:
        """The labels in a free judgement, if it has one clear verdict on every statement."""
        if self._settings.summarise == "always":
            return {}
        said = parse_labels(judgement, atoms)
        return {} if said.missing else said.labels

    def _sum_up(
        self, summing: ModelRequest, atoms: tuple[Atom, ...], cut_offs: CutOffs
    ) -> tuple[Mapping[Atom, bool | None], bool]:
        """The second stage: the labels that were found, and whether the reply was cut off."""
        summary = self._models.complete(summing)
        cut_off = cut_offs.check(self._models.by_role[summing.role], summing, summary)
        labels = {} if cut_off or summary.taken_back else parse_labels(summary.text, atoms).labels
        if not labels:
            self._models.take_back(summing)
        return labels, cut_off

    def _again(self, request: ModelRequest, problem: str, time: int) -> ModelRequest:
        return self._requests.again(request, problem, time) if time else request

    def _answer(self, tasks: Sequence[_Task], results: Iterator[_Labels]) -> EvaluationAnswer:
        """Join the batches and votes of a question; there is one result for each task."""
        labels: _Labels = {}
        agreement: dict[Atom, float] = {}
        for task in tasks[:: self._settings.votes]:
            votes = [next(results) for _ in range(self._settings.votes)]
            for atom in task.atoms:
                cast = [vote[atom] for vote in votes]
                labels[atom], agreement[atom] = majority(cast, self._settings.margin)
        return EvaluationAnswer(labels, agreement if self._settings.votes > 1 else {})


def _speaks_of_scene(text: str, question: EvaluationQuestion) -> bool:
    """Whether a free reply names anything it was asked about; refusals and nonsense do not."""
    said = fold(text)
    names = (*(o.name for o in question.objects), *(p.name for p in question.predicates))
    return any(fold(name) in said for name in names)


@lru_cache(maxsize=64)
def _groundings(predicates: tuple[Predicate, ...], objects: tuple[Object, ...]) -> tuple[Atom, ...]:
    return all_groundings(predicates, objects)


def majority(votes: Sequence[bool | None], margin: float = 0.0) -> tuple[bool | None, float]:
    """The label most votes are for, and the share of votes that are for it.

    Args:
        votes: at least one; a None counts for neither side.
        margin: by what share of all votes the winner must lead; a tie is always unknown.
    """
    if len(votes) == 1:
        return votes[0], 1.0
    counts = Counter(votes)
    yes, no = counts[True], counts[False]
    if yes == no or abs(yes - no) / len(votes) < margin:
        return None, max(yes, no, counts[None]) / len(votes)
    return yes > no, max(yes, no) / len(votes)

"""What a person has corrected in a run; it outranks what a model says (docs/review.md)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.invention.questions import (
    BatchInventionQuestion,
    InventionAnswer,
    InventionQuestion,
    RephrasingQuestion,
)
from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.runs.algorithm import Respondent
from skillwrapper.runs.archive.records import (
    CorrectionRecord,
    LabelCorrection,
    Rejection,
    Renaming,
    Rewording,
)
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.symbols.predicates import parse_atom


@dataclass(frozen=True)
class Corrections:
    """All corrections of a run, in the names that predicates have now.

    Attributes:
        labels: by an observation's key and a ground atom; None if it cannot be told.
        names: the present name of every predicate that was renamed, by each that it had.
        meanings: of predicates that were reworded, by present name.
        rejected: present names of predicates that are not wanted.
        words: the predicates that a person has named or worded, by present name.
    """

    labels: Mapping[tuple[str, Atom], bool | None] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    meanings: Mapping[str, str] = field(default_factory=dict)
    rejected: frozenset[str] = frozenset()
    words: Mapping[str, Predicate] = field(default_factory=dict)

    @classmethod
    def of(cls, records: Iterable[CorrectionRecord]) -> Corrections:
        """What corrections come to, one after the other."""
        corrections = cls()
        for record in records:
            corrections = corrections.after(record)
        return corrections

    def after(self, record: CorrectionRecord) -> Corrections:
        """The same with one more."""
        one = record.root
        match one:
            case LabelCorrection():
                labels = {**self.labels, (one.observation, parse_atom(one.atom)): one.value}
                return replace(self, labels=labels)
            case Renaming():
                named = Predicate(one.to, one.types, one.semantics)
                return self._renamed(one.predicate, named)
            case Rewording():
                worded = Predicate(one.predicate, one.types, one.semantics)
                return replace(
                    self,
                    meanings={**self.meanings, worded.name: worded.semantics},
                    words={**self.words, worded.name: worded},
                )
            case Rejection():
                words = {name: p for name, p in self.words.items() if name != one.predicate}
                return replace(self, rejected=self.rejected | {one.predicate}, words=words)

    def applied(self, predicate: Predicate) -> Predicate | None:
        """A predicate as it is now, by any of its names; None if it is rejected."""
        name = self.names.get(predicate.name, predicate.name)
        if name in self.rejected:
            return None
        return replace(predicate, name=name, semantics=self.meanings.get(name, predicate.semantics))

    def uses(self, name: str) -> bool:
        """Whether a predicate of this run has, or had, a name by a correction."""
        return name in self.names or name in self.names.values() or name in self.rejected

    def __bool__(self) -> bool:
        return bool(self.labels or self.names or self.meanings or self.rejected)

    def _renamed(self, old: str, named: Predicate) -> Corrections:
        new = named.name
        names = {had: new if now == old else now for had, now in {**self.names, old: old}.items()}
        labels = {
            (key, replace(atom, predicate=new) if atom.predicate == old else atom): value
            for (key, atom), value in self.labels.items()
        }
        meanings = {new if name == old else name: text for name, text in self.meanings.items()}
        words = {**{n: p for n, p in self.words.items() if n != old}, new: named}
        return replace(self, labels=labels, names=names, meanings=meanings, words=words)


class CorrectedRespondent:
    """Answers as another one does, but for what was corrected.

    Args:
        respondent: who answers.
        corrections: what stands above it.
    """

    def __init__(self, respondent: Respondent, corrections: Corrections) -> None:
        self._respondent, self._corrections = respondent, corrections

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        """As the other one."""
        return self._respondent.propose_sequences(question)

    def invent_predicates(self, question: InventionQuestion) -> InventionAnswer:
        """In the words of the person, and without what they rejected."""
        return self._corrected(self._respondent.invent_predicates(question))

    def rephrase_predicate(self, question: RephrasingQuestion) -> InventionAnswer:
        """In the words of the person, and without what they rejected."""
        return self._corrected(self._respondent.rephrase_predicate(question))

    def invent_batch(self, question: BatchInventionQuestion) -> InventionAnswer:
        """In the words of the person, and without what they rejected."""
        return self._corrected(self._respondent.invent_batch(question))

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        """With the labels of the person where there are any."""
        answers = self._respondent.evaluate(questions)
        return [
            self._corrected_labels(question, answer)
            for question, answer in zip(questions, answers, strict=True)
        ]

    def _corrected(self, answer: InventionAnswer) -> InventionAnswer:
        wanted = map(self._corrections.applied, answer.predicates)
        return replace(answer, predicates=tuple(p for p in wanted if p is not None))

    def _corrected_labels(
        self, question: EvaluationQuestion, answer: EvaluationAnswer
    ) -> EvaluationAnswer:
        known, key = self._corrections.labels, question.observation.key
        labels = {atom: known.get((key, atom), label) for atom, label in answer.labels.items()}
        return replace(answer, labels=labels)

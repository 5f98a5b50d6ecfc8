"""Trying out a model on pictures whose truth nobody has written down: is it at one with itself?

It is asked for words for what the pictures show, then for their labels: twice in the same way, and
once more with every predicate asked about alone. Who is right may be doubted; who contradicts
themselves, or says the same of everything, is not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from skillwrapper.invention.questions import BatchInventionQuestion
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.runs.findings import Finding, of_no_use
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.world.domain import Domain
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

WORDS = 4
"""Predicates that are asked for."""
_STEADY = 0.9
"""The share of labels that must be the same when they are asked for again."""
_CAVEAT = "whether they are right, only known answers tell (docs/domains.md)"

_Labels = Mapping[Atom, bool | None]


@dataclass(frozen=True)
class OwnPictures:
    """Pictures of a domain, of which nothing else is known.

    Attributes:
        domain: types, objects and skills.
        scene: what is present in them.
        observations: the pictures, at least one.
    """

    domain: Domain
    scene: Scene
    observations: tuple[Observation, ...]

    def question(self, predicates: Sequence[Predicate], seen: Observation) -> EvaluationQuestion:
        """Which of the predicates' groundings are true."""
        return EvaluationQuestion(self.domain, self.scene.objects, seen, tuple(predicates))


def check_consistency(
    once: Assistant, twice: Assistant, pictures: OwnPictures
) -> Iterator[Finding]:
    """Ask for words, and for labels in three ways; stops where nothing is left to compare.

    Args:
        once: asks for every label once.
        twice: asks the same model for every label twice (two votes).
        pictures: what is shown.

    Raises:
        ProviderError: if the model does not answer.
    """
    wanted = BatchInventionQuestion(pictures.domain, pictures.observations, WORDS)
    invented = once.invent_batch(wanted)
    if not invented.predicates:
        yield of_no_use("inventing predicates", invented.unusable)
        return
    first = invented.predicates[0]
    yield Finding("inventing predicates", True, f"e.g. {first.signature}: {first.semantics}")
    predicates = invented.predicates[:WORDS]
    answers = twice.evaluate([pictures.question(predicates, o) for o in pictures.observations])
    labels = [answer.labels for answer in answers]
    same = [share == 1.0 for answer in answers for share in answer.agreement.values()]
    if not same:
        yield of_no_use("reading pictures", ("no label in the whole reply",))
        return
    yield _compared("asked twice", same)
    if not any(label is not None for one in labels for label in one.values()):
        return  # it said both of everything
    alone = [[pictures.question([p], o) for p in predicates] for o in pictures.observations]
    yield _compared("asked one by one", list(_agreements(once, labels, alone)))
    yield _differs(labels)


def _agreements(
    assistant: Assistant, labels: Sequence[_Labels], alone: Sequence[list[EvaluationQuestion]]
) -> Iterator[bool]:
    """Whether labels that are known are the same where each predicate is asked about alone."""
    for together, questions in zip(labels, alone, strict=True):
        for answer in assistant.evaluate(questions):
            for atom, label in answer.labels.items():
                if label is not None and together[atom] is not None:
                    yield label == together[atom]


def _compared(check: str, same: Sequence[bool]) -> Finding:
    figures = f"{sum(same)} of {len(same)} labels are the same"
    if same and sum(same) >= _STEADY * len(same):
        return Finding(check, True, f"{figures}; {_CAVEAT}")
    advice = "choose another model, or learn with --votes 3"
    return Finding(check, False, f"{figures} only; it contradicts itself: {advice}")


def _differs(labels: Sequence[_Labels]) -> Finding:
    check = "telling things apart"
    values = {label for one in labels for label in one.values() if label is not None}
    if len(values) > 1:
        true = sum(label is True for one in labels for label in one.values())
        return Finding(check, True, f"{true} of {sum(map(len, labels))} statements are true")
    said = str(values.pop()).lower()
    return Finding(
        check,
        False,
        f"it says {said} of everything that it has named itself: it does not seem to look; choose "
        "another model",
    )

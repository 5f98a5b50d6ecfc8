"""Right and wrong labels, counted a grounding and a picture at a time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.types import Object

Readings = Mapping[Atom, bool | None]


@dataclass(frozen=True)
class PredicateScore:
    """How well a predicate is read.

    Attributes:
        predicate: its name.
        readings: groundings over all pictures.
        true: how many of them are true.
        false_positives: false ones read as true.
        false_negatives: true ones read as false.
        unknown: groundings left without a label.
        unknown_true: how many of these are true.
        arity: number of its parameters.
        pictures: number of pictures.
        pictures_right: pictures in which every grounding is read rightly.
    """

    predicate: str
    readings: int
    true: int
    false_positives: int
    false_negatives: int
    unknown: int
    pictures: int
    pictures_right: int
    unknown_true: int = 0
    arity: int = 0

    @property
    def accuracy(self) -> float | None:
        """Share of the groundings read rightly, an unknown one is not; None without any."""
        wrong = self.false_positives + self.false_negatives + self.unknown
        return (self.readings - wrong) / self.readings if self.readings else None

    @property
    def lifted_accuracy(self) -> float | None:
        """The paper's measure: share of the pictures with all groundings right; None without."""
        return self.pictures_right / self.pictures if self.pictures else None

    def to_json(self) -> dict[str, Any]:
        """Plain data with the accuracies."""
        accuracies = {"accuracy": self.accuracy, "lifted_accuracy": self.lifted_accuracy}
        return {**vars(self), **accuracies}


def score_predicate(
    predicate: Predicate,
    objects: Sequence[Object],
    truths: Sequence[Readings],
    readings: Sequence[Readings],
) -> PredicateScore:
    """Compare what was read in each picture with the truth, over all groundings."""
    atoms = predicate.groundings(objects)
    pairs = [
        [(truth.get(atom), read.get(atom)) for atom in atoms]
        for truth, read in zip(truths, readings, strict=True)
    ]
    flat = [pair for picture in pairs for pair in picture]
    return PredicateScore(
        predicate.name,
        readings=len(flat),
        true=sum(truth is True for truth, _ in flat),
        false_positives=sum(truth is False and read is True for truth, read in flat),
        false_negatives=sum(truth is True and read is False for truth, read in flat),
        unknown=sum(read is None for _, read in flat),
        pictures=len(pairs),
        pictures_right=sum(all(truth is read for truth, read in picture) for picture in pairs),
        unknown_true=sum(truth is True and read is None for truth, read in flat),
        arity=predicate.arity,
    )


def share_clean(truths: Sequence[Readings], readings: Sequence[Readings]) -> float | None:
    """The share of pictures in which nothing is misread; None without any."""
    clean = [
        all(read.get(atom) in (None, value) for atom, value in truth.items())
        for truth, read in zip(truths, readings, strict=True)
    ]
    return sum(clean) / len(clean) if clean else None


def mean_accuracy(scores: Iterable[PredicateScore], *, lifted: bool) -> float | None:
    """Mean over the predicates that were read, each counting alike, as in the paper."""
    values = [score.lifted_accuracy if lifted else score.accuracy for score in scores]
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None

"""The lexicon: all concepts, and finding the one that a written predicate means."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

from skillwrapper.embedded.concepts import Concept
from skillwrapper.embedded.contact_concepts import (
    HAND_CONCEPTS,
    LOOK_CONCEPTS,
    PLACE_CONCEPTS,
    STACK_CONCEPTS,
    on_named_place,
)
from skillwrapper.embedded.picture_concepts import PICTURE_CONCEPTS

GENERAL_CONCEPTS: tuple[Concept, ...] = (
    *PICTURE_CONCEPTS,
    *LOOK_CONCEPTS,
    *HAND_CONCEPTS,
    *PLACE_CONCEPTS,
    *STACK_CONCEPTS,
)
"""Where two concepts are found equally well in what somebody wrote, the earlier one is meant."""

_BY_MEANING = 3
_BY_NAME = 2
_EXACTLY = 4


@dataclass(frozen=True)
class Understanding:
    """What a written predicate means.

    Attributes:
        concept: the concept.
        order: for each parameter of the concept, which parameter of the predicate it is.
    """

    concept: Concept
    order: tuple[int, ...]

    def arranged(self, arguments: Sequence[str]) -> tuple[str, ...]:
        """Arguments of the predicate in the order of the concept."""
        return tuple(arguments[position] for position in self.order)


def all_concepts(places: Iterable[str]) -> tuple[Concept, ...]:
    """The lexicon with the concepts of lying on each of the named places."""
    return (*(on_named_place(name) for name in places), *GENERAL_CONCEPTS)


@lru_cache(maxsize=4096)
def understand(
    name: str, kinds: tuple[str, ...], semantics: str, places: tuple[str, ...]
) -> Understanding | None:
    """The concept that a predicate means, by its meaning first and its name second.

    Args:
        name: of the predicate.
        kinds: the kind of thing of every parameter.
        semantics: its meaning, may be empty.
        places: names of the stations in the scene.
    """
    words = _words(name)
    meaning = _plain(semantics)
    best: Understanding | None = None
    best_score = 0
    for candidate in _candidates(kinds, places):
        score = _score(candidate.concept, name, words, meaning)
        if score > best_score:
            best, best_score = candidate, score
    return best


def _candidates(kinds: tuple[str, ...], places: tuple[str, ...]) -> Iterator[Understanding]:
    for concept in all_concepts(places):
        for order in itertools.permutations(range(len(kinds))):
            if concept.fits([kinds[position] for position in order]):
                yield Understanding(concept, order)
                break


def _score(concept: Concept, name: str, words: str, meaning: str) -> int:
    score = 0
    if name in concept.names:
        score += _BY_NAME + _EXACTLY
    elif concept.pattern.search(words):
        score += _BY_NAME
    if any(pattern.fullmatch(meaning) for pattern in _own_meanings(concept)):
        score += _BY_MEANING + _EXACTLY
    elif meaning and concept.pattern.search(meaning):
        score += _BY_MEANING
    return score


@lru_cache(maxsize=1024)
def _own_meanings(concept: Concept) -> tuple[re.Pattern[str], ...]:
    """Its meanings with any words for the parameters; an order that is another's is none.

    ``first`` and ``second`` stay where the meaning has them, so that the inverse of a relation
    is not taken for the relation.
    """
    patterns = []
    for meaning in concept.meanings:
        text = re.escape(_plain(meaning).replace("{0}", "\x00").replace("{1}", "\x01"))
        text = text.replace("\x00", r"(?:(?!second\b)[\w\s-]+?)")
        patterns.append(re.compile(text.replace("\x01", r"(?:(?!first\b)[\w\s-]+?)")))
    return tuple(patterns)


def _plain(sentence: str) -> str:
    return " ".join(sentence.casefold().split()).rstrip(".")


def _words(name: str) -> str:
    """``StationFree``, ``station_free``: both ``station free``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|[_-]+", " ", name).casefold()

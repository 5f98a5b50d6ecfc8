"""The lexicon: all concepts for what a picture can show, and finding the one that is meant."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

from skillwrapper.embedded.concepts import Concept, Judge
from skillwrapper.embedded.denials import Said, what_is_said
from skillwrapper.embedded.facts import Fact, Sort
from skillwrapper.embedded.picture_concepts import PICTURE_CONCEPTS
from skillwrapper.embedded.relation_concepts import (
    Relation,
    landmark_concepts,
    relation_concepts,
)
from skillwrapper.embedded.scene_graph import Outline, SceneGraph
from skillwrapper.embedded.sight import Sight
from skillwrapper.embedded.words import PropertyWords, Words, general_words, joined_words

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


class Lexicon:
    """Knows concepts for everything that scene readers report.

    Where two concepts are found equally well in what somebody wrote, the earlier one is meant.

    Args:
        words: of domains, in addition to the general ones.
    """

    def __init__(self, words: Sequence[Words] = ()) -> None:
        self.words = joined_words(tuple(words))
        self.concepts = lru_cache(maxsize=64)(self._concepts)
        self._understand = lru_cache(maxsize=4096)(self._find)

    def understand(
        self, name: str, kinds: Sequence[str], semantics: str, graph: SceneGraph
    ) -> Understanding | None:
        """The concept that a predicate means, by its meaning first and its name second.

        Args:
            name: of the predicate.
            kinds: the kind of thing of every parameter.
            semantics: its meaning, may be empty.
            graph: what the picture shows.
        """
        return self._understand(name, tuple(kinds), semantics, graph.outline)

    def meaning(
        self, name: str, semantics: str, groundings: Iterable[Sequence[str]], graph: SceneGraph
    ) -> Understanding | None:
        """What a predicate means of the things it is said of; None if it is not understood.

        Args:
            name: of the predicate.
            semantics: its meaning, may be empty.
            groundings: the names that it is said of.
            graph: what the picture shows.
        """
        seen = (names for names in groundings if all(name in graph for name in names))
        for kinds in dict.fromkeys(tuple(map(graph.kind, names)) for names in seen):
            found = self.understand(name, kinds, semantics, graph)
            if found is not None:
                return found
        return None

    def relation(self, name: str) -> Relation:
        """A relation as it can be asked about."""
        return Relation(name, frozenset(self.words.relation(name).between))

    def _concepts(self, outline: Outline) -> tuple[Concept, ...]:
        """Every concept of what pictures of one world can show."""
        special = [name for name in outline.relations if name not in general_words().relations]
        common = [name for name in general_words().relations if name in outline.relations]
        relations = [(self.relation(n), self.words.relation(n)) for n in (*special, *common)]
        return (
            *(c for r, words in relations for c in landmark_concepts(r, words, outline)),
            *PICTURE_CONCEPTS,
            *(c for n in outline.conditions for c in _conditions(n, self.words.condition(n))),
            *(
                concept
                for name, kinds in outline.attributes
                for concept in _attributes(name, kinds, self.words.attribute(name))
            ),
            *(c for r, words in relations for c in relation_concepts(r, words)),
        )

    def _find(
        self, name: str, kinds: tuple[str, ...], semantics: str, outline: Outline
    ) -> Understanding | None:
        words, meaning = _words(name), _plain(semantics)
        best: Understanding | None = None
        best_score = 0
        concepts = self.concepts(outline)
        opposites = {(c.idea, c.arity, c.positive): c for c in concepts}
        for concept in concepts:
            opposite = opposites.get((concept.idea, concept.arity, not concept.positive))
            score = _score(concept, opposite, name, words, meaning)
            candidate = _arrange(concept, kinds) if score > best_score else None
            if candidate is not None:
                best, best_score = candidate, score
        return best


def _conditions(name: str, words: PropertyWords) -> tuple[Concept, ...]:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(Fact(Sort.CONDITION, name))

    return _both(name, 0, judge, words)


def _attributes(name: str, kinds: frozenset[str], words: PropertyWords) -> tuple[Concept, ...]:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(Fact(Sort.ATTRIBUTE, name, arguments))

    return _both(name, 1, judge, words, frozenset((kind,) for kind in kinds))


def _both(
    name: str,
    arity: int,
    judge: Judge,
    words: PropertyWords,
    kinds: frozenset[tuple[str, ...]] | None = None,
) -> tuple[Concept, ...]:
    """The opposite first: ``uncut`` and ``not cut`` are no ``cut``."""
    return (
        Concept(f"not {name}", name, arity, judge, words.opposite, kinds, positive=False),
        Concept(name, name, arity, judge, words, kinds),
    )


def _arrange(concept: Concept, kinds: tuple[str, ...]) -> Understanding | None:
    """The concept of things of the given kinds, in the first order that makes sense."""
    for order in itertools.permutations(range(len(kinds))):
        if concept.fits([kinds[position] for position in order]):
            return Understanding(concept, order)
    return None


def _score(concept: Concept, opposite: Concept | None, name: str, words: str, meaning: str) -> int:
    """How surely a name and a meaning are meant to be a concept; 0 for not at all."""
    if _means(concept, meaning):
        return _BY_MEANING + _EXACTLY + _by_name(concept, opposite, name, words)
    said = what_is_said(concept, opposite, meaning) if meaning else Said.NOTHING
    if said in (Said.DENIED, Said.UNCLEAR):
        return 0
    if meaning and opposite is not None and _is_said(opposite, concept, meaning):
        return 0  # the name says one thing, or the meaning both
    by_name = _by_name(concept, opposite, name, words)
    return by_name + (_BY_MEANING if said is Said.YES else 0)


def _by_name(concept: Concept, opposite: Concept | None, name: str, words: str) -> int:
    if name in concept.wording.names:
        return _BY_NAME + _EXACTLY
    return _BY_NAME if what_is_said(concept, opposite, words) is Said.YES else 0


def _means(concept: Concept, meaning: str) -> bool:
    """Whether a meaning is one of a concept's own."""
    own = _own_meanings(concept.wording.meanings)
    return bool(meaning) and any(pattern.fullmatch(meaning) for pattern in own)


def _is_said(concept: Concept, opposite: Concept, meaning: str) -> bool:
    return _means(concept, meaning) or what_is_said(concept, opposite, meaning) is Said.YES


@lru_cache(maxsize=1024)
def _own_meanings(meanings: tuple[str, ...]) -> tuple[re.Pattern[str], ...]:
    """Meanings with any words for the parameters; an order that is another's is none.

    ``first`` and ``second`` stay where the meaning has them, so that the inverse of a relation
    is not taken for the relation.
    """
    patterns = []
    for meaning in meanings:
        text = re.escape(_plain(meaning).replace("{0}", "\x00").replace("{1}", "\x01"))
        text = text.replace("\x00", r"(?:(?!second\b)[\w\s-]+?)")
        patterns.append(re.compile(text.replace("\x01", r"(?:(?!first\b)[\w\s-]+?)")))
    return tuple(patterns)


def _plain(sentence: str) -> str:
    return " ".join(sentence.casefold().split()).rstrip(".")


def _words(name: str) -> str:
    """``StationFree``, ``station_free``: both ``station free``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|[_-]+", " ", name).casefold()

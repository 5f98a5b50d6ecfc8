"""Finding concepts that tell situations apart: the core of inventing a predicate."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from skillwrapper.embedded.concepts import Concept
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.prompt_text import PromptText
from skillwrapper.embedded.sight import Sight


@dataclass(frozen=True)
class Idea:
    """A concept that might become a predicate.

    Attributes:
        concept: the concept.
        types: types of its parameters.
        telling: whether it tells the situations apart that were compared.
    """

    concept: Concept
    types: tuple[str, ...]
    telling: bool


@dataclass(frozen=True)
class Views:
    """What is seen of one execution.

    Attributes:
        arguments: names of the objects the skill was run on.
        before: what was seen before.
        after: what was seen afterwards, if the prompt shows it.
    """

    arguments: tuple[str, ...]
    before: Sight
    after: Sight | None = None


class Comparison:
    """Looks for telling concepts.

    Args:
        prompt: the invention prompt; its allowed parameters and skill are used.
        lexicon: the concepts.
    """

    def __init__(self, prompt: PromptText, lexicon: Lexicon) -> None:
        self._prompt, self._lexicon = prompt, lexicon
        self._skill_types = prompt.skills[0].types if prompt.skills else ()

    def of_situations(self, first: Views, second: Views) -> Iterator[Idea]:
        """Concepts of the arguments, telling if they hold before one execution only."""
        for concept, types, places in self._choices(first):
            one = _truth(concept, first.before, first.arguments, places)
            two = _truth(concept, second.before, second.arguments, places)
            yield Idea(concept, types, one is not None and two is not None and one is not two)

    def of_changes(self, success: Views, failure: Views) -> Iterator[Idea]:
        """Concepts of the arguments, telling if they change in the success only."""
        for concept, types, places in self._choices(success):
            changed = _changed(concept, success, places)
            yield Idea(concept, types, changed and not _changed(concept, failure, places))

    def of_one_change(self, views: Views) -> Iterator[Idea]:
        """Concepts of the arguments, telling if they change."""
        for concept, types, places in self._choices(views):
            yield Idea(concept, types, _changed(concept, views, places))

    def of_relations(self, views: Views, others: Iterable[str]) -> Iterator[Idea]:
        """Relations between an argument and one of the others, telling if they change."""
        if views.after is None:
            return
        for argument, other in itertools.product(views.arguments, others):
            for pair in ((argument, other), (other, argument)):
                types = self._types_of(pair, views.arguments)
                for concept in self._concepts(views.before, pair) if types else ():
                    was = concept.truth(views.before, pair)
                    now = concept.truth(views.after, pair)
                    yield Idea(concept, types, None not in {was, now} and was is not now)

    def _choices(self, views: Views) -> Iterator[tuple[Concept, tuple[str, ...], tuple[int, ...]]]:
        """Concepts for every choice of at most two of the skill's parameters."""
        positions = range(min(len(views.arguments), len(self._skill_types)))
        for count in (0, 1, 2):
            for places in itertools.permutations(positions, count):
                types = tuple(self._skill_types[place] for place in places)
                if all(name in self._prompt.allowed for name in types):
                    chosen = tuple(views.arguments[place] for place in places)
                    for concept in self._concepts(views.before, chosen):
                        yield concept, types, places

    def _concepts(self, sight: Sight, names: Sequence[str]) -> Iterator[Concept]:
        kinds = [sight.graph.kind(name) for name in names]
        concepts = self._lexicon.concepts(sight.graph.outline)
        return (c for c in concepts if all(kinds) and c.fits(kinds))

    def _types_of(self, pair: tuple[str, str], arguments: tuple[str, ...]) -> tuple[str, ...]:
        """Allowed types for two objects; empty if one has none or a type is used too often."""
        own = dict(zip(arguments, self._skill_types, strict=False))
        types = []
        for name in pair:
            has = self._prompt.objects.get(name, frozenset())
            fitting = [t for t in self._prompt.allowed if t in has]
            if not fitting:
                return ()
            types.append(own[name] if own.get(name) in fitting else self._widest(fitting))
        if any(types.count(t) > self._prompt.allowed[t] for t in types):
            return ()
        return tuple(types)

    def _widest(self, types: Sequence[str]) -> str:
        """The type that most objects have."""
        held = list(self._prompt.objects.values())
        return max(types, key=lambda name: (sum(name in has for has in held), name))


def _truth(
    concept: Concept, sight: Sight, arguments: tuple[str, ...], places: tuple[int, ...]
) -> bool | None:
    return concept.truth(sight, tuple(arguments[place] for place in places))


def _changed(concept: Concept, views: Views, places: tuple[int, ...]) -> bool:
    if views.after is None:
        return False
    was = _truth(concept, views.before, views.arguments, places)
    now = _truth(concept, views.after, views.arguments, places)
    return None not in {was, now} and was is not now

"""The concepts that a relation gives: who stands in it to whom, to something, to nothing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from skillwrapper.embedded.concepts import Concept, Judge
from skillwrapper.embedded.facts import Fact, Sort
from skillwrapper.embedded.scene_graph import Outline
from skillwrapper.embedded.sight import Sight
from skillwrapper.embedded.words import RelationWords, Wording

Kinds = frozenset[tuple[str, ...]] | None


@dataclass(frozen=True)
class Relation:
    """A relation as it can be asked about.

    Attributes:
        name: as the scene reader calls it.
        between: pairs of kinds of which it is said; none for any.
    """

    name: str
    between: frozenset[tuple[str, str]]

    def allows(self, first: str, second: str) -> bool:
        """Whether it is said of things of two kinds."""
        return not self.between or (first, second) in self.between

    def fact(self, first: str, second: str) -> Fact:
        """That one thing stands in it to another one."""
        return Fact(Sort.RELATION, self.name, (first, second))

    def facts_of(self, sight: Sight, first: str, kind: str | None = None) -> Iterator[Fact]:
        """Everything to which a thing may stand in it, of one kind or of all.

        Scenery has no names: a thing is seen on a table, not on one of the tables.
        """
        own, asked = sight.graph.kind(first), set()
        for thing in sight.graph.things:
            if thing.name == first or kind not in {None, thing.kind}:
                continue
            if not self.allows(own, thing.kind):
                continue
            if not thing.scenery:
                yield self.fact(first, thing.name)
            elif thing.kind not in asked:
                asked.add(thing.kind)
                yield Fact(Sort.RELATION_TO_KIND, self.name, (first, thing.kind))

    def stands(self, sight: Sight, first: str, kind: str | None = None) -> bool:
        """Whether a thing stands in it to something, of one kind or of any."""
        return any(sight.holds(fact) for fact in self.facts_of(sight, first, kind))

    def carries_like(self, sight: Sight, second: str) -> bool:
        """Whether a thing of the same kind stands in it to a thing."""
        alike = sight.graph.names(sight.graph.kind(second))
        return any(sight.holds(self.fact(name, second)) for name in alike if name != second)

    def reaches(self, sight: Sight, first: str, second: str) -> bool:
        """Whether one thing stands in it to another one, directly or over like things."""
        like = sight.graph.names(sight.graph.kind(first))
        waiting, passed = [first], {first}
        while waiting:
            name = waiting.pop()
            if name != second and sight.holds(self.fact(name, second)):
                return True
            onward = [n for n in like if n not in passed and sight.holds(self.fact(name, n))]
            passed.update(onward)
            waiting += onward
        return False


def landmark_concepts(relation: Relation, words: RelationWords, outline: Outline) -> list[Concept]:
    """Standing in a relation to furniture, by its name or by its kind."""
    return _concepts(_landmark_forms(relation, words, outline))


def relation_concepts(relation: Relation, words: RelationWords) -> list[Concept]:
    """The other concepts of a relation, those first that are meant in cases of doubt."""
    return _concepts(_plain_forms(relation, words))


def _concepts(forms: Iterable[_Form]) -> list[Concept]:
    return [
        Concept(
            key=form.key,
            idea=form.idea or form.key,
            arity=form.arity,
            judge=form.judge,
            wording=form.wording,
            kinds=form.kinds,
            positive=form.positive,
        )
        for form in forms
        if form.wording is not None and form.kinds != frozenset()
    ]


@dataclass(frozen=True)
class _Form:
    """One way to speak of a relation; see ``Concept``."""

    key: str
    wording: Wording | None
    judge: Judge
    kinds: Kinds
    arity: int = 1
    idea: str = ""
    positive: bool = True


def _landmark_forms(relation: Relation, words: RelationWords, outline: Outline) -> Iterator[_Form]:
    """Landmarks are what itself stands in the relation to nothing."""
    landmarks = {second for _, second in relation.between} - {
        first for first, _ in relation.between
    }
    for kind in sorted(landmarks):
        kinds = frozenset((first,) for first, second in relation.between if second == kind)
        names = outline.named(kind)
        for name in names if len(names) > 1 else ():
            wording = words.at_name and words.at_name.about(name=name)
            yield _Form(f"{relation.name} {name}", wording, _at_name(relation, name), kinds)
        wording = words.at_kind and words.at_kind.about(kind=kind)
        yield _Form(f"{relation.name} some {kind}", wording, _at_kind(relation, kind), kinds)


def _plain_forms(relation: Relation, words: RelationWords) -> Iterator[_Form]:
    between, name = relation.between, relation.name
    pairs = frozenset(between) if between else None
    firsts = frozenset((first,) for first, _ in between) if between else None
    seconds = frozenset((second,) for _, second in between) if between else None
    like = frozenset((a,) for a, b in between if a == b) if between else None
    like_pairs = frozenset((a, b) for a, b in between if a == b) if between else None
    inverted = frozenset((b, a) for a, b in between) if between else None
    vacancy = f"nothing {name}"

    def is_vacant(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(Fact(Sort.VACANCY, name, arguments))

    def direct(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(relation.fact(*arguments))

    def inverse(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(relation.fact(*reversed(arguments)))

    def stands(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return relation.stands(sight, arguments[0])

    def stands_on_like(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return relation.stands(sight, arguments[0], sight.graph.kind(arguments[0]))

    def carries_like(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return relation.carries_like(sight, arguments[0])

    def is_lowest(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return carries_like(sight, arguments) and not stands_on_like(sight, arguments)

    def is_highest(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return stands_on_like(sight, arguments) and not carries_like(sight, arguments)

    def is_part(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return stands_on_like(sight, arguments) or carries_like(sight, arguments)

    def reaches(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return relation.reaches(sight, *arguments)

    yield _Form(f"above {name}", words.above, reaches, like_pairs, 2)
    yield _Form(f"lowest {name}", words.lowest, is_lowest, like)
    yield _Form(f"highest {name}", words.highest, is_highest, like)
    yield _Form(f"part {name}", words.part, is_part, like)
    yield _Form(vacancy, words.vacant, is_vacant, seconds)
    yield _Form(f"something {name}", words.taken, is_vacant, seconds, 1, vacancy, False)
    yield _Form(f"inverse {name}", words.inverse, inverse, inverted, 2, name)
    yield _Form(name, words.direct, direct, pairs, 2)
    yield _Form(f"somewhere {name}", words.somewhere, stands, firsts)


def _at_name(relation: Relation, name: str) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return sight.holds(relation.fact(arguments[0], name))

    return judge


def _at_kind(relation: Relation, kind: str) -> Judge:
    def judge(sight: Sight, arguments: tuple[str, ...]) -> bool:
        return relation.stands(sight, arguments[0], kind)

    return judge

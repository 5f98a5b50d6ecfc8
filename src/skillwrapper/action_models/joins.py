"""Bindings of parameters by joins: one positive literal after the other, the narrowest first.

Products of objects are formed only over parameters that no positive literal binds, and whatever
else is asked for is checked as soon as its parameters are bound.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from skillwrapper.action_models.skeleton import TypedName
from skillwrapper.action_models.steps import State

Words = tuple[str, ...]

Literal = tuple[bool, Words]
"""Whether it must hold, and the words of its atom."""

Binding = Mapping[str, str]

EQUAL = "="


def holds(state: State, literal: Literal, binding: Binding) -> bool:
    """Whether a literal holds in a state once its parameters are bound."""
    positive, words = literal
    if words[0] == EQUAL:
        first, second = (binding.get(word, word) for word in words[1:])
        return (first == second) is positive
    return (ground(words, binding) in state) is positive


def ground(words: Words, binding: Binding) -> str:
    """An atom as states hold it."""
    return " ".join([binding.get(word, word) for word in words])


@dataclass
class Effort:
    """How much may still be searched.

    Attributes:
        left: how many more partial bindings are looked at; below 0 if more were needed.
    """

    left: int


class Facts:
    """The atoms of a state, to be looked up by some of their terms.

    Args:
        state: the true atoms.
    """

    def __init__(self, state: State) -> None:
        self.state = state
        self._by_predicate: dict[str, list[Words]] = {}
        for atom in state:
            words = tuple(atom.split(" "))
            self._by_predicate.setdefault(words[0], []).append(words)
        self._indexes: dict[tuple[str, tuple[int, ...]], dict[Words, list[Words]]] = {}

    def count(self, predicate: str) -> int:
        """How many atoms of a predicate are true."""
        return len(self._by_predicate.get(predicate, ()))

    def matching(self, predicate: str, places: tuple[int, ...], terms: Words) -> Sequence[Words]:
        """The atoms of a predicate that have certain terms at certain places (from 1 on)."""
        if not places:
            return self._by_predicate.get(predicate, ())
        index = self._indexes.get((predicate, places))
        if index is None:
            index = self._indexes[predicate, places] = {}
            for words in self._by_predicate.get(predicate, ()):
                index.setdefault(tuple([words[p] for p in places]), []).append(words)
        return index.get(terms, ())


@dataclass(frozen=True)
class _Stage:
    """What binds some more parameters.

    Attributes:
        pattern: the literal; a parameter alone, if nothing else binds it.
        places: where the pattern has terms that are known by then, and which terms.
        known: these terms.
        new: where it has parameters that are bound now.
        checks: what can be checked after it.
    """

    pattern: Words
    places: tuple[int, ...]
    known: Words
    new: tuple[int, ...]
    checks: tuple[Literal, ...]


class Join:
    """Finds all bindings with which a conjunction holds in a state.

    Args:
        parameters: what is to be bound.
        literals: the conjunction; atoms of ``=`` may be among it.
        facts: the state.
        allowed: which objects may stand for every parameter.
        effort: the search ends without an error when it is spent; by default it never is.
    """

    def __init__(
        self,
        parameters: Sequence[TypedName],
        literals: Iterable[Literal],
        facts: Facts,
        allowed: Mapping[str, frozenset[str]],
        effort: Effort | None = None,
    ) -> None:
        self._effort = effort
        self._names = tuple([p.name for p in parameters])
        self._literals = tuple(literals)
        self._facts, self._allowed = facts, allowed

    def bindings(self) -> Iterator[Words]:
        """The objects that stand for the parameters, each binding once."""
        counts = [self._facts.count(words[0]) for _, words in self._literals]
        if any(
            count == 0 and positive and words[0] != EQUAL
            for count, (positive, words) in zip(counts, self._literals, strict=True)
        ):
            return
        magnitudes = tuple([count.bit_length() for count in counts])
        self._stages = _plan(self._names, self._literals, magnitudes)
        yield from self._extend({}, 0)

    def _extend(self, binding: dict[str, str], number: int) -> Iterator[Words]:
        stage = self._stages[number]
        if number + 1 == len(self._stages):
            if self._passes(stage, binding):
                yield tuple([binding[name] for name in self._names])
            return
        for words in self._choices(stage, binding):
            if self._effort is not None:
                self._effort.left -= 1
                if self._effort.left < 0:
                    return
            more = self._bind(stage, words, binding)
            if more is not None and self._passes(stage, more):
                yield from self._extend(more, number + 1)

    def _choices(self, stage: _Stage, binding: dict[str, str]) -> Iterable[Words]:
        if stage.pattern[0] == EQUAL:
            return ((EQUAL, name) for name in sorted(self._allowed[stage.pattern[1]]))
        terms = tuple([binding.get(term, term) for term in stage.known])
        return self._facts.matching(stage.pattern[0], stage.places, terms)

    def _bind(self, stage: _Stage, words: Words, binding: dict[str, str]) -> dict[str, str] | None:
        """The binding with what a fact adds; None if it does not fit."""
        if not stage.new:
            return binding
        more = dict(binding)
        for place in stage.new:
            name, found = stage.pattern[place], words[place]
            if more.setdefault(name, found) != found or found not in self._allowed[name]:
                return None
        return more

    def _passes(self, stage: _Stage, binding: dict[str, str]) -> bool:
        return all(holds(self._facts.state, literal, binding) for literal in stage.checks)


def _parameters(words: Words) -> set[str]:
    return {word for word in words if word.startswith("?")}


@lru_cache(4096)
def _plan(
    names: tuple[str, ...], literals: tuple[Literal, ...], magnitudes: tuple[int, ...]
) -> list[_Stage]:
    """In which order parameters are bound, where predicates have about 2^magnitude atoms each."""
    size = {words[0]: m for (_, words), m in zip(literals, magnitudes, strict=True)}
    patterns = [words for positive, words in literals if positive and words[0] != EQUAL]
    checks = [x for x in literals if not x[0] or x[1][0] == EQUAL]
    bound: set[str] = set()
    stages = []
    while patterns or not bound.issuperset(names):
        pattern = _next(patterns, bound, names, size)
        terms = list(enumerate(pattern))[1:]
        places = tuple(i for i, t in terms if t in bound or not t.startswith("?"))
        new = tuple(i for i, t in terms if i not in places)
        bound.update(pattern[i] for i in new)
        ready = [c for c in checks if bound.issuperset(_parameters(c[1]))]
        checks = [c for c in checks if c not in ready]
        known = tuple(pattern[i] for i in places)
        stages.append(_Stage(pattern, places, known, new, tuple(ready)))
    return [*stages, _Stage((), (), (), (), tuple(checks))]


def _next(
    patterns: list[Words], bound: set[str], names: tuple[str, ...], size: Mapping[str, int]
) -> Words:
    """The pattern that leaves least to choose; a parameter without any if none is left."""
    if not patterns:
        return EQUAL, next(name for name in names if name not in bound)

    def width(pattern: Words) -> tuple[bool, float]:
        loose = sum(t not in bound and t.startswith("?") for t in pattern[1:])
        return loose == len(pattern) - 1 > 0, size[pattern[0]] * loose / len(pattern)

    chosen = min(patterns, key=width)
    patterns.remove(chosen)
    return chosen

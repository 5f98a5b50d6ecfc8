"""Planning domains as they are run: which actions apply in a state, and what comes of them."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.action_models.lisp import Form, read_form
from skillwrapper.action_models.skeleton import DomainSkeleton, TypedName
from skillwrapper.action_models.skeleton_files import read_pairs, skeleton_of
from skillwrapper.action_models.steps import State
from skillwrapper.files.json_documents import read_text

Literal = tuple[bool, tuple[str, ...]]
"""Whether it must hold, and the words of its atom."""


@dataclass(frozen=True)
class Action:
    """An action with all that it asks for and does.

    Attributes:
        name: its name.
        parameters: names and types.
        preconditions: literals; atoms of ``=`` among them.
        effects: what must hold for a change (nothing for always), and the change.
    """

    name: str
    parameters: tuple[TypedName, ...]
    preconditions: tuple[Literal, ...]
    effects: tuple[tuple[tuple[Literal, ...], Literal], ...]

    def apply(self, state: State, arguments: tuple[str, ...]) -> State:
        """The state that follows; what is deleted and added is there."""
        binding = dict(zip((p.name for p in self.parameters), arguments, strict=True))
        made: dict[bool, set[str]] = {True: set(), False: set()}
        for condition, (positive, words) in self.effects:
            if all(_holds(state, literal, binding) for literal in condition):
                made[positive].add(_ground(words, binding))
        return (state - made[False]) | made[True]


@dataclass(frozen=True)
class Strips:
    """A domain of which everything is known.

    Attributes:
        skeleton: its types, predicates and parameters.
        actions: by name.
    """

    skeleton: DomainSkeleton
    actions: Mapping[str, Action]

    def applicable(
        self, state: State, objects: Mapping[str, str]
    ) -> Iterator[tuple[str, tuple[str, ...]]]:
        """Names and arguments of all actions that apply in a state.

        Args:
            state: the true atoms.
            objects: the type of every object.
        """
        known = {**{c.name: c.types[0] for c in self.skeleton.constants}, **objects}
        facts: dict[str, list[tuple[str, ...]]] = {}
        for atom in state:
            words = tuple(atom.split(" "))
            facts.setdefault(words[0], []).append(words)
        for action in self.actions.values():
            join = _Join(action, self.skeleton, state, facts, known)
            for arguments in join.bindings({}, join.positive):
                yield action.name, arguments


@dataclass(frozen=True)
class _Join:
    """Binds the parameters of an action, one positive precondition after the other."""

    action: Action
    skeleton: DomainSkeleton
    state: State
    facts: Mapping[str, list[tuple[str, ...]]]
    objects: Mapping[str, str]

    @property
    def positive(self) -> list[tuple[str, ...]]:
        return [words for holds, words in self.action.preconditions if holds and words[0] != "="]

    def bindings(
        self, bound: dict[str, str], left: list[tuple[str, ...]]
    ) -> Iterator[tuple[str, ...]]:
        if not left:
            yield from self._free(bound)
            return
        place = max(range(len(left)), key=lambda i: self._known(left[i], bound))
        pattern, rest = left[place], left[:place] + left[place + 1 :]
        for fact in self.facts.get(pattern[0], ()):
            more = self._match(pattern, fact, bound)
            if more is not None:
                yield from self.bindings(more, rest)

    def _known(self, pattern: tuple[str, ...], bound: Mapping[str, str]) -> tuple[float, int]:
        fixed = sum(not t.startswith("?") or t in bound for t in pattern[1:])
        return fixed / max(1, len(pattern) - 1), -len(self.facts.get(pattern[0], ()))

    def _match(
        self, pattern: tuple[str, ...], fact: tuple[str, ...], bound: Mapping[str, str]
    ) -> dict[str, str] | None:
        found = dict(bound)
        for term, name in zip(pattern[1:], fact[1:], strict=True):
            if not term.startswith("?"):
                if term != name:
                    return None
            elif found.setdefault(term, name) != name:
                return None
        return found

    def _free(self, bound: dict[str, str]) -> Iterator[tuple[str, ...]]:
        for parameter in self.action.parameters:
            if parameter.name not in bound:
                for name in self.objects:
                    yield from self._free({**bound, parameter.name: name})
                return
        names = [bound[p.name] for p in self.action.parameters]
        for parameter, name in zip(self.action.parameters, names, strict=True):
            if not self.skeleton.fits(TypedName(name, (self.objects[name],)), parameter):
                return
        if all(_holds(self.state, literal, bound) for literal in self.action.preconditions):
            yield tuple(names)


def _holds(state: State, literal: Literal, binding: Mapping[str, str]) -> bool:
    positive, words = literal
    ground = _ground(words, binding)
    if words[0] == "=":
        _, first, second = ground.split(" ")
        return (first == second) is positive
    return (ground in state) is positive


def _ground(words: tuple[str, ...], binding: Mapping[str, str]) -> str:
    return " ".join(binding.get(word, word) for word in words)


def read_strips(path: Path) -> Strips:
    """Read a PDDL domain with its preconditions and effects."""
    domain = read_form(read_text(path), str(path))
    skeleton = skeleton_of(domain)
    actions = {}
    for form in domain.forms:
        if form.head == ":action":
            name = str(form.items[1])
            pairs = itertools.pairwise(form.items)
            parts = {key: value for key, value in pairs if isinstance(key, str)}
            conditions = tuple(_literals(parts.get(":precondition")))
            effects = tuple(_effects(parts.get(":effect")))
            actions[name] = Action(name, skeleton.actions[name].parameters, conditions, effects)
    return Strips(skeleton, actions)


def read_objects(path: Path) -> dict[str, str]:
    """The objects of a PDDL problem with their types."""
    for form in read_form(read_text(path), str(path)).forms:
        if form.head == ":objects":
            return {name: types[0] for name, types in read_pairs(form, form.items[1:])}
    return {}


def _literals(form: object) -> Iterator[Literal]:
    if not isinstance(form, Form) or not form.items:
        return
    if form.head == "and":
        for part in form.forms:
            yield from _literals(part)
    elif form.head == "not":
        for positive, words in _literals(form.forms[0]):
            yield not positive, words
    else:
        yield True, tuple(form.words)


def _effects(form: object) -> Iterator[tuple[tuple[Literal, ...], Literal]]:
    if not isinstance(form, Form) or not form.items:
        return
    if form.head == "and":
        for part in form.forms:
            yield from _effects(part)
    elif form.head == "when":
        condition, change = form.forms
        for literal in _literals(change):
            yield tuple(_literals(condition)), literal
    else:
        for literal in _literals(form):
            yield (), literal

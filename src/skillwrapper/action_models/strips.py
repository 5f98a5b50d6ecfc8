"""Planning domains as they are run: which actions apply in a state, and what comes of them."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.action_models.joins import Facts, Join, Literal, ground, holds
from skillwrapper.action_models.lisp import Form, read_form
from skillwrapper.action_models.skeleton import DomainSkeleton, TypedName
from skillwrapper.action_models.skeleton_files import read_pairs, skeleton_of
from skillwrapper.action_models.steps import State
from skillwrapper.files.json_documents import read_text


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
            if all(holds(state, literal, binding) for literal in condition):
                made[positive].add(ground(words, binding))
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
        facts = Facts(state)
        fitting: dict[tuple[str, ...], frozenset[str]] = {}
        for action in self.actions.values():
            for parameter in action.parameters:
                if parameter.types not in fitting:
                    fitting[parameter.types] = self._fitting(parameter, known)
            allowed = {p.name: fitting[p.types] for p in action.parameters}
            join = Join(action.parameters, action.preconditions, facts, allowed)
            for arguments in join.bindings():
                yield action.name, arguments

    def _fitting(self, parameter: TypedName, objects: Mapping[str, str]) -> frozenset[str]:
        kinds = {kind for kind in objects.values() if self.skeleton.accepts(kind, parameter)}
        return frozenset(name for name, kind in objects.items() if kind in kinds)


def read_strips(path: Path) -> Strips:
    """Read a PDDL domain with its preconditions and effects.

    Raises:
        UserError: if it cannot be read or says what cannot be; names file and line.
    """
    return parse_strips(read_text(path), str(path))


def parse_strips(text: str, name: str) -> Strips:
    """As ``read_strips``, from the text of a file of some name."""
    domain = read_form(text, name)
    skeleton = skeleton_of(domain)
    actions = {}
    for form in domain.forms:
        if form.head == ":action":
            action = str(form.items[1])
            pairs = itertools.pairwise(form.items)
            parts = {key: value for key, value in pairs if isinstance(key, str)}
            conditions = tuple(_literals(parts.get(":precondition")))
            effects = tuple(_effects(parts.get(":effect")))
            parameters = skeleton.actions[action].parameters
            actions[action] = Action(action, parameters, conditions, effects)
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

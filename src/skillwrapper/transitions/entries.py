"""Labelled transitions from plain data, such as the lines of a file; no picture is needed.

An entry says which objects were there, what was run, whether it succeeded, and what was true
before and after: the true atoms (all others are false), or for single atoms whether they are true
(``true``, ``false``, ``null`` for unknown, or a probability; all others are unknown).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, PlainValidator, StrictBool, ValidationError

from skillwrapper.errors import ConfigurationError, SymbolError, UnknownNameError, UserError
from skillwrapper.files.mistakes import first_mistake
from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.symbols.predicates import parse_atom
from skillwrapper.transitions.executions import Executions
from skillwrapper.transitions.inferred import infer_predicates
from skillwrapper.transitions.labelled import (
    Confidence,
    LabelledTransitions,
    SceneTransitions,
)
from skillwrapper.world.domain import Domain
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object


def _check_state(value: object) -> list[str] | dict[str, float | None]:
    expected = "true, false, null or a probability"
    if isinstance(value, list) and all(isinstance(atom, str) for atom in value):
        return value
    if not isinstance(value, dict) or not all(isinstance(atom, str) for atom in value):
        raise ValueError(f"expected a list of the true atoms, or atoms with {expected}")
    for atom, probability in value.items():
        number = isinstance(probability, bool | int | float)
        if probability is not None and not (number and 0 <= probability <= 1):
            raise ValueError(f"expected {expected} for '{atom}'")
    return {atom: None if p is None else float(p) for atom, p in value.items()}


State = Annotated[list[str] | dict[str, float | None], PlainValidator(_check_state)]
"""The true atoms, or for single atoms the probability that they are true."""


class TransitionEntry(BaseModel):
    """One transition as plain data.

    Attributes:
        skill: name of the skill.
        arguments: names of the objects.
        success: whether the skill succeeded.
        before: what was true before.
        after: what was true after; may be left out where nothing changed.
        scene: name of the scene; by default the domain's first one.
        objects: what is present instead of a scene of the domain: names of its objects, or names
            with a type or types each.
        changed: whether anything changed, where the robot knows.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    skill: str
    arguments: list[str] = Field(default_factory=list)
    success: StrictBool
    before: State
    after: State | None = None
    scene: str | None = None
    objects: list[str] | dict[str, str | list[str]] | None = None
    changed: StrictBool | None = None


@dataclass(frozen=True)
class PlacedEntry:
    """An entry and where it stands, for complaints, e.g. ``moves.jsonl:3``."""

    where: str
    entry: TransitionEntry


def label_entries(
    domain: Domain,
    entries: Iterable[Mapping[str, Any] | TransitionEntry],
    predicates: Sequence[Predicate] | None = None,
) -> LabelledTransitions:
    """Labelled transitions from plain data, in order of time.

    Args:
        domain: types, skills, and objects where the entries bring none of their own.
        entries: the transitions.
        predicates: the vocabulary; None to infer names and types from the atoms.

    Raises:
        UserError: for the first entry that cannot be used; says which and why.
    """
    placed = [
        PlacedEntry(f"transition {number}", _validated(entry, f"transition {number}"))
        for number, entry in enumerate(entries, start=1)
    ]
    return label_placed_entries(domain, placed, predicates)


def label_placed_entries(
    domain: Domain,
    entries: Sequence[PlacedEntry],
    predicates: Sequence[Predicate] | None = None,
) -> LabelledTransitions:
    """As ``label_entries``, for entries that know where they stand."""
    steps = [_step(domain, placed) for placed in entries]
    if predicates is None:
        seen = ((s.where, s.scene, atom) for s in steps for atom in s.atoms)
        predicates = infer_predicates(domain.types, seen)
    scenes: dict[Scene, list[tuple[int, _Step]]] = {}
    for number, step in enumerate(steps):
        scenes.setdefault(step.scene, []).append((number, step))
    labelled = (_label_scene(scene, own, predicates) for scene, own in scenes.items())
    return LabelledTransitions(domain, tuple(predicates), tuple(labelled))


def _validated(entry: Mapping[str, Any] | TransitionEntry, where: str) -> TransitionEntry:
    try:
        return TransitionEntry.model_validate(entry)
    except ValidationError as error:
        mistake = first_mistake(error, TransitionEntry)
        raise ConfigurationError(f"{where}: {mistake.text}") from error


_Facts = dict[Atom, float | None]


@dataclass(frozen=True)
class _Step:
    """An entry with its names understood.

    Attributes:
        where: where it stands.
        scene: what is present.
        instance: what was run.
        success: whether it succeeded.
        before: the probabilities of atoms before.
        after: the same after; None if the state did not change.
        rest: what all other atoms are, before and after: FALSE or UNKNOWN.
    """

    where: str
    scene: Scene
    instance: SkillInstance
    success: bool
    before: _Facts
    after: _Facts | None
    rest: tuple[int, int]

    @property
    def atoms(self) -> Iterable[Atom]:
        """All atoms that are named."""
        return (*self.before, *(self.after or ()))


def _step(domain: Domain, placed: PlacedEntry) -> _Step:
    entry, where = placed.entry, placed.where
    unchanged = domain.failures_change_nothing and not entry.success
    if entry.changed is not None:
        unchanged = not entry.changed
    if entry.after is None and not unchanged:
        raise ConfigurationError(
            f"{where}: expected a value for 'after', got none; it can be left out only if "
            "'changed' is false, or of failures in a domain with failures_change_nothing"
        )
    try:
        scene = _scene(domain, entry)
        after = None if unchanged or entry.after is None else entry.after
        return _Step(
            where,
            scene,
            _instance(domain, scene, entry),
            entry.success,
            _facts(entry.before),
            None if after is None else _facts(after),
            (_rest(entry.before), _rest(entry.before if after is None else after)),
        )
    except UserError as error:
        raise ConfigurationError(f"{where}: {error}") from error


def _rest(state: State) -> int:
    return FALSE if isinstance(state, list) else UNKNOWN


def _scene(domain: Domain, entry: TransitionEntry) -> Scene:
    if entry.objects is None:
        return domain.scene(entry.scene)
    for name in entry.objects:
        if isinstance(entry.objects, list) and name not in domain.object_by_name:
            raise UnknownNameError("object", name, domain.object_by_name)
    name = entry.scene or ", ".join(entry.objects)
    if isinstance(entry.objects, list):
        return Scene.of(name, entry.objects, domain.objects)
    return Scene(name, tuple(_object(domain, *pair) for pair in entry.objects.items()))


def _object(domain: Domain, name: str, types: str | list[str]) -> Object:
    own = [types] if isinstance(types, str) else types
    for type_name in own:
        if type_name not in domain.types.parents:
            raise UnknownNameError("type", type_name, domain.types.names)
    return Object(name, tuple(sorted(domain.types.closure(own))))


def _instance(domain: Domain, scene: Scene, entry: TransitionEntry) -> SkillInstance:
    instance = SkillInstance(entry.skill, tuple(entry.arguments))
    skill = domain.skill_by_name.get(entry.skill)
    if skill is None:
        raise UnknownNameError("skill", entry.skill, domain.skill_by_name)
    present = {o.name: o for o in scene.objects}
    for name in instance.arguments:
        if name not in present:
            raise UnknownNameError("object", name, present)
    if not skill.accepts([present[name] for name in instance.arguments]):
        expected = ", ".join(p.type for p in skill.parameters)
        raise ConfigurationError(
            f"{instance}: expected different objects of the types ({expected})"
        )
    return instance


def _facts(state: State) -> _Facts:
    named = dict.fromkeys(state, 1.0) if isinstance(state, list) else state
    facts: _Facts = {}
    for text, probability in named.items():
        atom = parse_atom(text)
        if facts.setdefault(atom, probability) != probability:
            raise SymbolError(f"{atom} is given twice")
    return facts


def _label_scene(
    scene: Scene, steps: Sequence[tuple[int, _Step]], predicates: Sequence[Predicate]
) -> SceneTransitions:
    space = AtomSpace(tuple(predicates), scene.objects)
    values = np.empty((2 * len(steps), len(space.atoms)), dtype=np.int8)
    confidence: Confidence = np.ones(values.shape, dtype=np.float32)
    for place, (_, step) in enumerate(steps):
        for row, facts, rest in (
            (2 * place, step.before, step.rest[0]),
            (2 * place + 1, step.after or {}, step.rest[1]),
        ):
            values[row] = rest
            _fill(space, facts, step.where, values[row], confidence[row])
    return SceneTransitions.of(_executions(scene, steps), space, values, confidence)


def _fill(
    space: AtomSpace, facts: _Facts, where: str, values: Labels, confidence: Confidence
) -> None:
    """Enter probabilities as the likelier label and its confidence."""
    for atom, probability in facts.items():
        column = space.column.get(atom)
        if column is None:
            raise ConfigurationError(f"{where}: {_complaint(space, atom)}")
        if probability is None or probability == 0.5:
            values[column] = UNKNOWN
        else:
            values[column] = TRUE if probability > 0.5 else FALSE
            confidence[column] = max(probability, 1 - probability)


def _complaint(space: AtomSpace, atom: Atom) -> str:
    known = {p.name: p for p in space.predicates}
    if atom.predicate not in known:
        return str(UnknownNameError("predicate", atom.predicate, known))
    objects = {o.name for o in space.objects}
    for name in atom.terms:
        if name not in objects:
            return str(UnknownNameError("object", name, objects))
    expected = ", ".join(known[atom.predicate].types)
    return f"{atom}: expected different objects of the types ({expected})"


def _executions(scene: Scene, steps: Sequence[tuple[int, _Step]]) -> Executions:
    instances = tuple(sorted({step.instance for _, step in steps}))
    place = {instance: number for number, instance in enumerate(instances)}
    before = 2 * np.arange(len(steps), dtype=np.intp)
    unchanged = np.array([step.after is None for _, step in steps], dtype=bool)
    return Executions(
        scene,
        instances,
        which=np.array([place[step.instance] for _, step in steps], dtype=np.intp),
        success=np.array([step.success for _, step in steps], dtype=bool),
        before=before,
        after=np.where(unchanged, before, before + 1),
        unchanged=unchanged,
        ids=np.array([number for number, _ in steps], dtype=np.intp),
    )

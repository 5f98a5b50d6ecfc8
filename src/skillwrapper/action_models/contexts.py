"""Several operators for one action whose effects depend on context, for planners without ``when``.

In every state exactly one of them applies where the action does, and does what the action does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from skillwrapper.action_models.models import ActionModel, Condition, Effect
from skillwrapper.action_models.skeleton import LiftedAtom, Schema

_Known = Mapping[LiftedAtom, bool]


@dataclass(frozen=True)
class _Context:
    """Where an action does one thing.

    Attributes:
        when: what holds there.
        changes: what it does there, without conditions.
    """

    when: tuple[Condition, ...]
    changes: frozenset[Condition]


def separate(model: ActionModel, taken: Iterable[str]) -> Iterator[ActionModel]:
    """An action as operators without conditional effects.

    Args:
        model: the action; if it has no such effects, it is all there is.
        taken: the names of all actions; operators get others, numbered from 1.
    """
    if not any(effect.when for effect in model.effects):
        yield model
        return
    known = {c.atom: c.holds for c in model.preconditions}
    names = _names(model.action.name, frozenset(taken))
    for context, name in zip(_contexts(model.effects, known), names, strict=False):
        yield replace(
            model,
            action=Schema(name, model.action.parameters),
            preconditions=tuple(sorted({*model.preconditions, *context.when})),
            effects=tuple(sorted(map(Effect, context.changes))),
        )


def _names(name: str, taken: frozenset[str]) -> Iterator[str]:
    number = 1
    while True:
        if f"{name}-{number}" not in taken:
            yield f"{name}-{number}"
        number += 1


def _contexts(effects: Iterable[Effect], known: _Known) -> list[_Context]:
    """Where the effects differ, given what is known; two that do the same are one."""
    effects = [e for e in effects if all(known.get(c.atom, c.holds) == c.holds for c in e.when)]
    atom = next((c.atom for e in effects for c in e.when if c.atom not in known), None)
    if atom is None:
        return [_Context((), _changes(effects))]
    halves = {truth: _contexts(effects, {**known, atom: truth}) for truth in (True, False)}
    if halves[True] == halves[False]:
        return halves[True]
    return [
        replace(context, when=(Condition(atom, truth), *context.when))
        for truth, found in halves.items()
        for context in found
    ]


def _changes(effects: Iterable[Effect]) -> frozenset[Condition]:
    """What effects do together; of an atom that is added and deleted, the addition counts."""
    made = {effect.change for effect in effects}
    return frozenset(c for c in made if c.holds or Condition(c.atom) not in made)

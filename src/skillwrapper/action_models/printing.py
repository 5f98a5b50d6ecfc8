"""Action models as PDDL, under the names of actions and parameters that were given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

from skillwrapper.action_models.contexts import separate
from skillwrapper.action_models.models import ActionModel, DomainModel, Effect
from skillwrapper.action_models.skeleton import ROOT, DomainSkeleton, Schema, TypedName

_NUMERIC = frozenset({":action-costs", ":fluents", ":numeric-fluents"})


def print_model(
    model: DomainModel, effects: Literal["conditional", "separate"] = "conditional"
) -> str:
    """The domain; equal models give equal text.

    Args:
        model: the domain.
        effects: whether an action whose effects depend on context is one, with conditional
            effects, or several, which are named after it and numbered.
    """
    skeleton = model.skeleton
    actions = [model.actions[name] for name in skeleton.actions if name in model.actions]
    if effects == "separate":
        actions = [one for action in actions for one in separate(action, skeleton.actions)]
    parts = [f"  (:requirements {' '.join(_requirements(skeleton, actions))})"]
    types = [
        TypedName(name, skeleton.types.parents[name] or (ROOT,)) for name in skeleton.types.names
    ]
    parts += _section(":types", (_typed(t) for t in types))
    parts += _section(":constants", (_typed(t) for t in skeleton.constants))
    parts += _section(":predicates", map(_predicate, skeleton.predicates.values()))
    parts += _section(":functions", [" ".join(skeleton.functions)] if skeleton.functions else [])
    parts += map(_action, actions)
    return f"(define (domain {skeleton.name})\n" + "\n".join(parts) + "\n)\n"


def _requirements(skeleton: DomainSkeleton, actions: Sequence[ActionModel]) -> Iterator[str]:
    conditions = [c for a in actions for c in a.preconditions]
    effects = [e for a in actions for e in a.effects]
    yield ":strips"
    yield ":typing"
    if any(not c.holds for c in (*conditions, *(w for e in effects for w in e.when))):
        yield ":negative-preconditions"
    if any(c.atom.predicate == "=" for c in conditions):
        yield ":equality"
    if any(e.when for e in effects):
        yield ":conditional-effects"
    if skeleton.functions:
        yield from sorted(skeleton.requirements & _NUMERIC)


def _section(head: str, lines: Iterable[str]) -> list[str]:
    found = [f"    {line}" for line in lines]
    return [f"  ({head}", *found, "  )"] if found else []


def _typed(thing: TypedName) -> str:
    kind = thing.types[0] if len(thing.types) == 1 else f"(either {' '.join(thing.types)})"
    return f"{thing.name} - {kind}"


def _predicate(schema: Schema) -> str:
    return f"({' '.join((schema.name, *map(_typed, schema.parameters)))})"


def _action(model: ActionModel) -> str:
    parameters = " ".join(map(_typed, model.action.parameters))
    return "\n".join(
        [
            f"  (:action {model.action.name}",
            f"    :parameters ({parameters})",
            f"    :precondition {_and(model.preconditions)}",
            f"    :effect {_and([_effect(e) for e in model.effects])}",
            "  )",
        ]
    )


def _effect(effect: Effect) -> str:
    return f"(when {_and(effect.when)} {effect.change})" if effect.when else str(effect.change)


def _and(parts: Sequence[object]) -> str:
    return f"(and {' '.join(map(str, parts))})" if parts else "(and)"

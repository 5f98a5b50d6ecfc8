"""Names that planners take: lower case, ASCII, unique, no keywords (DESIGN.md D3).

Planners lower-case everything and some keep types, predicates, actions and objects in one
namespace, so all names of a model are made different from each other, whatever they name.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from skillwrapper.symbols.model import AbstractModel
from skillwrapper.world.types import Object

_KEYWORDS = """
action all always and assign at axiom both constants decrease define derived domain duration
effect either end exists false forall functions goal imply increase init maximize metric minimize
new not number object objects oneof or over parameters precondition preconditions predicates
preference problem requirements scale-down scale-up sometime start thing timeless total-cost
total-time true types undefined when within
"""
KEYWORDS = frozenset(_KEYWORDS.split())


def unique_names(names: Iterable[str], taken: set[str]) -> dict[str, str]:
    """A planner-safe name for every name, none of them in ``taken``, which is extended.

    Args:
        names: any names; the first of several that look alike keeps its plain form.
        taken: safe names that are in use already.
    """
    safe = {}
    for name in names:
        if name not in safe:
            safe[name] = _unique(_plain(name), taken)
            taken.add(safe[name])
    return safe


def _plain(name: str) -> str:
    plain = re.sub(r"[^a-z0-9_-]", "_", name.lower())
    return plain if re.match(r"[a-z]", plain) else f"x{plain}"


def _unique(plain: str, taken: set[str]) -> str:
    if plain not in taken and plain not in KEYWORDS:
        return plain
    number = 2
    while f"{plain}_{number}" in taken:
        number += 1
    return f"{plain}_{number}"


@dataclass(frozen=True)
class PlannerNames:
    """The planner-safe names of everything in a model; learned name to safe name.

    Attributes:
        types: object types.
        predicates: predicates.
        operators: operators.
        objects: objects of the scene.
    """

    types: dict[str, str]
    predicates: dict[str, str]
    operators: dict[str, str]
    objects: dict[str, str]

    @classmethod
    def of(cls, model: AbstractModel, objects: Iterable[Object] = ()) -> PlannerNames:
        """Name everything; the names do not depend on the objects, which come last."""
        taken: set[str] = set()
        return cls(
            types=unique_names(model.domain.types.names, taken),
            predicates=unique_names(sorted(p.name for p in model.predicates), taken),
            operators=unique_names((o.name for o in model.operators), taken),
            objects=unique_names((o.name for o in objects), taken),
        )


def variable_names(names: Iterable[str]) -> dict[str, str]:
    """Planner-safe names of the variables of one operator, all with their question marks."""
    learned = tuple(names)
    safe = unique_names((name.lstrip("?") for name in learned), set())
    return {name: f"?{safe[name.lstrip('?')]}" for name in learned}

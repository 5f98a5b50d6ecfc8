"""Names that planners take: lower case, ASCII, unique, no keywords (docs/semantics.md, D3).

Planners lower-case everything and some keep types, predicates, actions and objects in one
namespace, so all names of a model are made different from each other, whatever they name.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable
from dataclasses import dataclass

from skillwrapper.symbols.model import AbstractModel
from skillwrapper.world.types import Object

_KEYWORDS = """
action all always and assign at at-most-once axiom both constants decrease define derived domain
duration effect either end exists false forall functions goal hold-after hold-during imply increase
init maximize metric minimize new not number object objects oneof or over parameters precondition
preconditions predicates preference problem requirements scale-down scale-up sometime
sometime-after sometime-before start timeless total-cost total-time true types undefined
unknown when within
"""
KEYWORDS = frozenset(_KEYWORDS.split())
"""Words of PDDL 3.1 and of its readers; not all readers take them as names."""


def unique_names(names: Iterable[str], taken: set[str]) -> dict[str, str]:
    """A planner-safe name for every name, none of them in ``taken``, which is extended.

    Args:
        names: any names; the first of several that look alike keeps its plain form.
        taken: safe names that are in use already.
    """
    return {name: unique_name(name, taken) for name in dict.fromkeys(names)}


def unique_name(name: str, taken: set[str]) -> str:
    """A planner-safe name that is not in ``taken``, to which it is added."""
    plain = _plain(name)
    numbered = (f"{plain}_{number}" for number in itertools.count(2))
    safe = next(
        candidate
        for candidate in itertools.chain([plain], numbered)
        if candidate not in taken and candidate not in KEYWORDS
    )
    taken.add(safe)
    return safe


def _plain(name: str) -> str:
    plain = re.sub(r"[^a-z0-9_-]", "_", name.lower())
    return plain if re.match(r"[a-z]", plain) else f"x{plain}"


@dataclass(frozen=True)
class PlannerNames:
    """The planner-safe names of everything in a model; learned name to safe name.

    Attributes:
        domain: the domain itself.
        types: object types.
        predicates: predicates.
        operators: operators.
        root: a type that all objects have; the ``pddl`` library refuses ``object``.
        objects: objects of the scene.
    """

    domain: str
    types: dict[str, str]
    predicates: dict[str, str]
    operators: dict[str, str]
    root: str
    objects: dict[str, str]

    @classmethod
    def of(cls, model: AbstractModel, objects: Iterable[Object] = ()) -> PlannerNames:
        """Name everything; the names do not depend on the objects, which come last."""
        taken: set[str] = set()
        return cls(
            domain=unique_name(model.domain.name, set()),
            types=unique_names(model.domain.types.names, taken),
            predicates=unique_names(sorted(p.name for p in model.predicates), taken),
            operators=unique_names((o.name for o in model.operators), taken),
            root=unique_name("thing", taken),
            objects=unique_names((o.name for o in objects), taken),
        )

    @property
    def altered(self) -> tuple[tuple[str, str, str], ...]:
        """What is named, its learned and its safe name, where more than the case differs.

        Objects are left out: they are no part of a domain.
        """
        kinds = (("type", self.types), ("predicate", self.predicates), ("operator", self.operators))
        return tuple(
            (kind, learned, safe)
            for kind, names in kinds
            for learned, safe in names.items()
            if safe != learned.lower()
        )


def variable_names(names: Iterable[str]) -> dict[str, str]:
    """Planner-safe names of the variables of one operator, all with their question marks."""
    learned = tuple(names)
    safe = unique_names((name.lstrip("?") for name in learned), set())
    return {name: f"?{safe[name.lstrip('?')]}" for name in learned}

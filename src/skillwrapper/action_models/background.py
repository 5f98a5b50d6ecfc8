"""What the steps of all actions together say, beside the views of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skillwrapper.action_models.views import ActionViews, ViewTable
from skillwrapper.action_models.witnesses import Witnesses


@dataclass(frozen=True, eq=False)
class Background:
    """What is known of a domain when the preconditions of one action are looked for.

    Attributes:
        seen: the predicates of which anything was ever true.
        dynamic: the predicates of which anything ever changed.
        witnesses: states in which conditions are told from each other.
    """

    seen: frozenset[str]
    dynamic: frozenset[str]
    witnesses: Witnesses


def background_of(
    views: Mapping[str, ActionViews], tables: Mapping[str, ViewTable], witnesses: Witnesses
) -> Background:
    """What all actions' views and the states that were kept say together."""
    seen, dynamic = set(witnesses.predicates), set[str]()
    for name, table in tables.items():
        seen |= views[name].seen(table)
        dynamic |= views[name].changed(table)
    return Background(frozenset(seen), frozenset(dynamic), witnesses)

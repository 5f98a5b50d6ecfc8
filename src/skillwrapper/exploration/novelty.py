"""How new an attempt is: what is seen from a skill instance, beside what earlier attempts saw."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE, AtomSpace
from skillwrapper.grounding.abstract_states import different_rows
from skillwrapper.grounding.atom_index import ANY, LiftedAtom, taken_objects
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.symbols import Predicate

Features = NDArray[np.bool_]
"""What holds, seen from the skill instance of an attempt (attempts, features)."""


def see_features(space: AtomSpace, attempts: Attempts, types: Sequence[str]) -> Features:
    """Literals over the arguments, what stands in relations to them, and their types.

    Args:
        space: the ground atoms; the same predicates give the same features in every scene.
        attempts: attempts at one skill.
        types: all types that tell objects apart.
    """
    arguments, which = attempts.arguments, attempts.which
    arity = arguments.shape[1]
    of_type = np.array([space.index.of_types([name]) for name in types], dtype=bool)
    of_type = of_type.reshape(len(types), len(space.objects))
    plain, opened = _plain(space.predicates, arity), _open(space.predicates, arity)
    holds, related = look_up(space, attempts, plain, opened)
    by_type = related.astype(np.float32) @ of_type.T.astype(np.float32) > 0
    seen = np.hstack([holds, by_type.reshape(len(holds), by_type.shape[1] * len(types))])
    own_types = of_type.T[arguments].reshape(len(arguments), arity * len(types))
    return np.hstack([seen, ~seen, own_types[which]])


def look_up(
    space: AtomSpace,
    attempts: Attempts,
    plain: Iterable[LiftedAtom],
    opened: Iterable[LiftedAtom],
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """What holds of the arguments, and of each other object with them.

    Args:
        space: the ground atoms.
        attempts: attempts at one skill.
        plain: atoms over the places of the arguments.
        opened: atoms of which one term is ``ANY``.

    Returns:
        Whether each holds: (attempts, plain), and (attempts, opened, objects) with each object in
        turn as the open term; no argument is one.
    """
    index, arguments, which = space.index, attempts.arguments, attempts.which
    arity = arguments.shape[1]
    closed = index.columns(index.patterns(plain, arity), arguments)
    open_columns = index.open_columns(index.patterns(opened, arity), arguments)
    others = ~taken_objects(arguments, len(space.objects))
    open_columns = np.where(others[:, np.newaxis, :], open_columns, -1)
    holds = attempts.states.at(attempts.rows, closed[which]) == TRUE
    related = attempts.states.at(attempts.rows, open_columns[which]) == TRUE
    return holds, related


def _plain(predicates: Sequence[Predicate], arity: int) -> Iterator[LiftedAtom]:
    for predicate in predicates:
        for terms in itertools.permutations(range(arity), predicate.arity):
            yield predicate.name, terms


def _open(predicates: Sequence[Predicate], arity: int) -> Iterator[LiftedAtom]:
    for predicate in predicates:
        for place in range(predicate.arity if predicate.arity > 1 else 0):
            for terms in itertools.permutations(range(arity), predicate.arity - 1):
                yield predicate.name, (*terms[:place], ANY, *terms[place:])


@dataclass(frozen=True, eq=False)
class Novelty:
    """How new attempts are.

    Attributes:
        alone: whether something is seen that was never seen, 1, or almost, 0.5 (attempts,).
        pairs: the share of pairs of what is seen that were never seen together (attempts,).
    """

    alone: NDArray[np.float64]
    pairs: NDArray[np.float64]


class Earlier:
    """What earlier attempts saw, and what they saw together; worked out once.

    Args:
        features: what each saw (attempts, features).
    """

    def __init__(self, features: Features) -> None:
        before = features.astype(np.float32)
        self._unseen = (before.T @ before == 0).astype(np.float32)

    def novelty(self, seen: Features) -> Novelty:
        """How new attempts are that see something (attempts, features)."""
        first, place = different_rows(seen)
        rows = seen[first].astype(np.float32)
        alone = np.clip(rows @ np.diag(self._unseen) / 2, 0, 1)
        total = np.maximum(rows.sum(axis=1) ** 2, 1)
        pairs = ((rows @ self._unseen) * rows).sum(axis=1) / total
        return Novelty(alone[place], pairs[place])

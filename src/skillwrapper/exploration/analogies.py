"""Analogies: where other skills work, a skill that never succeeded may need only little more.

The skills of one robot ask for like things: a free hand, nothing on top, something on something. So
the conditions of every other operator are read as a family of attempts at the skill, its parameters
being the operator's in some order, and other objects being of any type. Within such a family, what
no failure of the family had is worth a try, even if other failures had it.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.novelty import Features, look_up
from skillwrapper.grounding import AtomSpace
from skillwrapper.grounding.atom_index import ANY, LiftedAtom
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.learning.version_space import VersionSpace
from skillwrapper.symbols import Absence, Literal

_LIKELY = 0.5
"""Conditions that are needed less likely are left out."""


@dataclass(frozen=True)
class Family:
    """What holds in attempts of a family: atoms over the places of the arguments.

    One term may be ``ANY``: some object that is no argument.

    Attributes:
        needed: hold.
        barred: do not.
    """

    needed: frozenset[LiftedAtom]
    barred: frozenset[LiftedAtom]


class Analogies:
    """The families that the operators of other skills make.

    Args:
        spaces: what is believed of the operators of other skills.
        arity: how many arguments the skill takes.
        in_order: whether parameters are only those in the same place; so it is with operators of
            the skill itself, for arguments of other types.
    """

    def __init__(
        self, spaces: Sequence[VersionSpace], arity: int, *, in_order: bool = False
    ) -> None:
        found = dict.fromkeys(f for space in spaces for f in _families(space, arity, in_order))
        self._families = tuple(found)
        atoms = dict.fromkeys(a for f in self._families for a in sorted(f.needed | f.barred))
        self._closed = [atom for atom in atoms if ANY not in atom[1]]
        self._open = [atom for atom in atoms if ANY in atom[1]]
        order = [*self._closed, *self._open]
        self._needed = self._matrix(order, lambda family: family.needed)
        self._barred = self._matrix(order, lambda family: family.barred)

    def members(self, space: AtomSpace, attempts: Attempts) -> NDArray[np.bool_]:
        """Which attempts are of which family (attempts, families)."""
        plain, related = look_up(space, attempts, self._closed, self._open)
        holds = np.hstack([plain, related.any(axis=2)]).astype(np.float32)
        amiss = (1 - holds) @ self._needed.T + holds @ self._barred.T
        members: NDArray[np.bool_] = amiss == 0
        return members

    def _matrix(
        self, order: Sequence[LiftedAtom], part: Callable[[Family], frozenset[LiftedAtom]]
    ) -> NDArray[np.float32]:
        rows = [[atom in part(family) for atom in order] for family in self._families]
        return np.array(rows, dtype=np.float32).reshape(len(self._families), len(order))


def newness(
    seen: Features,
    members: NDArray[np.bool_],
    failed: Features,
    failed_members: NDArray[np.bool_],
) -> NDArray[np.float64]:
    """How new attempts are within a family (attempts,), 0 to 1, the most of all families.

    Args:
        seen: what holds in the attempts (attempts, features).
        members: of which families they are (attempts, families).
        failed: what held in failures (failures, features).
        failed_members: of which families those were (failures, families).
    """
    before = failed_members.T.astype(np.float32) @ failed.astype(np.float32) > 0
    unseen = np.clip(seen.astype(np.float32) @ ~before.T / 2, 0, 1)
    found: NDArray[np.float64] = (members * unseen).max(axis=1, initial=0.0)
    return found


def _families(space: VersionSpace, arity: int, in_order: bool) -> Iterator[Family]:
    """One for every order of the operator's own parameters that needs anything of the arguments."""
    operator = space.operator
    likely = [c for c in space.conditions if space.probability[c] >= _LIKELY]
    own = [variable.name for variable in operator.parameters[: operator.arity]]
    spare = [ANY] * max(0, len(own) - arity)
    orders = sorted(set(itertools.permutations([*range(arity), *spare], len(own))))
    for places in orders[:1] if in_order else orders:
        place = {v.name: ANY for v in operator.context} | dict(zip(own, places, strict=True))
        needed, barred = set(), set()
        for condition in likely:
            match condition:
                case Literal():
                    atom = condition.atom.predicate, _placed(condition.atom.terms, place)
                    if condition.positive:
                        needed.add(atom)
                    elif ANY not in atom[1]:
                        barred.add(atom)
                case Absence():
                    barred.add((
                        condition.atom.predicate, _placed(condition.atom.terms, place)
                    ))  # fmt: skip
        family = Family(frozenset(filter(_can_be_told, needed)),
                        frozenset(filter(_can_be_told, barred)))  # fmt: skip
        if family.needed:
            yield family


def _placed(terms: Sequence[str], place: Mapping[str, int]) -> tuple[int, ...]:
    return tuple(place.get(term, ANY) for term in terms)


def _can_be_told(atom: LiftedAtom) -> bool:
    """Whether it says something of the arguments, and of one other object at most."""
    terms = atom[1]
    others = terms.count(ANY)
    return others == 0 or (others == 1 and len(terms) > 1)

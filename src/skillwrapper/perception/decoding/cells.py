"""Edges times atoms, flat: which variables hang together, and in which roles.

A *variable* is a ground atom in a picture, a *cell* a ground atom on an edge. Cells of one *role*
follow one rule: the same kind of step and skill, the same predicate, the same places of arguments
among its terms.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.decoding.chains import Chain, Step, StepKind
from skillwrapper.symbols import Predicate

Integers = NDArray[np.intp]

OTHER = -1
"""The place of a term that is no argument."""


@dataclass(frozen=True)
class Role:
    """What cells of one rule have in common.

    Attributes:
        kind: of the step.
        skill: its name, if it is one.
        predicate: the number of the predicate.
        terms: for every term the argument that stands there, or ``OTHER``.
    """

    kind: StepKind
    skill: str
    predicate: int
    terms: tuple[int, ...]

    @property
    def others(self) -> int:
        """How many terms are no arguments."""
        return self.terms.count(OTHER)


@dataclass(frozen=True, eq=False)
class ChainCells:
    """The part of one chain.

    Attributes:
        chain: the chain.
        space: its ground atoms.
        first: number of its first variable; that of atom ``a`` in node ``n`` is
            ``first + n * atoms + a``.
        roles: (steps, atoms) the role of every cell.
        other: (steps, atoms) the number of the object that is no argument, if it is just one.
    """

    chain: Chain
    space: AtomSpace
    first: int
    roles: Integers
    other: Integers

    @property
    def variables(self) -> slice:
        """All of its variables."""
        return slice(self.first, self.first + self.chain.nodes * len(self.space.atoms))


class Cells:
    """All variables and cells of several chains, for one vocabulary.

    Args:
        chains: the chains.
        predicates: the vocabulary.

    Attributes:
        parts: what belongs to each chain.
        roles: all roles.
        variables: number of variables.
        predicate: for every variable (variables,) the number of its predicate.
        picture: for every variable (variables,) the number of its picture among all.
        role: for every cell (cells,) its role; cells are sorted by it.
        before: for every cell (cells,) the variable before.
        after: for every cell (cells,) the variable after.
        edge: for every cell (cells,) its edge among all.
        part: for every cell (cells,) its chain.
        step: for every cell (cells,) its step in its chain.
        atom: for every cell (cells,) its atom in its chain.
        edges: number of edges between different pictures.
        weight: for every edge (edges,) how much it may count.
    """

    def __init__(self, chains: Sequence[Chain], predicates: Sequence[Predicate]) -> None:
        self.predicates = tuple(predicates)
        self.parts, self.roles = _parts(chains, self.predicates)
        self.variables = sum(p.chain.nodes * len(p.space.atoms) for p in self.parts)
        self.pictures = sum(p.chain.nodes for p in self.parts)
        number = {p.name: place for place, p in enumerate(self.predicates)}
        own = [
            np.array([number[a.predicate] for a in p.space.atoms], dtype=np.intp)
            for p in self.parts
        ]
        self.predicate = _joined(
            [np.tile(o, p.chain.nodes) for o, p in zip(own, self.parts, strict=True)]
        )
        sizes = [len(p.space.atoms) for p in self.parts for _ in range(p.chain.nodes)]
        self.picture = np.repeat(np.arange(self.pictures), sizes)
        self._lay_out()

    @cached_property
    def slices(self) -> tuple[slice, ...]:
        """For every role its cells."""
        bounds = np.searchsorted(self.role, np.arange(len(self.roles) + 1)).tolist()
        return tuple(slice(a, b) for a, b in pairwise(bounds))

    @cached_property
    def follows(self) -> NDArray[np.bool_]:
        """Which variables (variables,) stand at the end of some edge."""
        follows = np.zeros(self.variables, dtype=bool)
        follows[self.after] = True
        return follows

    @cached_property
    def ran(self) -> tuple[Integers, Integers]:
        """Variables before successes that speak of arguments alone, and their roles."""
        variables, roles = [], []
        speaks = np.array([role.others == 0 for role in self.roles], dtype=bool)
        for part in self.parts:
            chain, atoms = part.chain, len(part.space.atoms)
            kinds = np.array([s.kind is StepKind.SUCCESS for s in chain.steps], dtype=bool)
            pairs = np.unique(np.stack([chain.before, chain.which], axis=1), axis=0)
            pairs = pairs[kinds[pairs[:, 1]]] if len(pairs) else pairs
            found = part.roles[pairs[:, 1]]
            row, atom = np.nonzero(speaks[found])
            variables.append(part.first + pairs[row, 0] * atoms + atom)
            roles.append(found[row, atom])
        return _joined(variables), _joined(roles)

    def _lay_out(self) -> None:
        columns: list[list[Integers]] = []
        edges = 0
        for number, part in enumerate(self.parts):
            chain, atoms = part.chain, len(part.space.atoms)
            moves = chain.moves
            steps = np.repeat(chain.which[moves], atoms)
            atom = np.tile(np.arange(atoms), len(moves))
            before = part.first + np.repeat(chain.before[moves] * atoms, atoms) + atom
            after = part.first + np.repeat(chain.after[moves] * atoms, atoms) + atom
            edge = edges + np.repeat(np.arange(len(moves)), atoms)
            place = np.full(len(atom), number)
            columns.append([part.roles[steps, atom], before, after, edge, place, steps, atom])
            edges += len(moves)
        role, *rest = (_joined(c) for c in zip(*columns, strict=True)) if columns else [_NONE] * 7
        order = np.argsort(role, kind="stable")
        self.edges, self.role = edges, role[order]
        self.weight = np.concatenate([np.zeros(0), *(p.chain.weights for p in self.parts)])
        self.before, self.after, self.edge, self.part, self.step, self.atom = (
            column[order] for column in rest
        )


_NONE = np.zeros(0, dtype=np.intp)


def _joined(arrays: Sequence[Integers]) -> Integers:
    return np.concatenate([_NONE, *arrays]).astype(np.intp)


def _parts(
    chains: Sequence[Chain], predicates: tuple[Predicate, ...]
) -> tuple[tuple[ChainCells, ...], tuple[Role, ...]]:
    """The parts of all chains, with roles that they share."""
    events = dict.fromkeys((s.kind, s.skill) for c in chains for s in c.steps)
    number = {event: place for place, event in enumerate(events)}
    arity = max((p.arity for p in predicates), default=0)
    base = 2 + max((len(s.arguments) for c in chains for s in c.steps), default=0)
    spaces = [AtomSpace(predicates, c.scene.objects) for c in chains]
    coded = [
        _codes(chain.steps, [number[s.kind, s.skill] for s in chain.steps], space, base, arity)
        for chain, space in zip(chains, spaces, strict=True)
    ]
    keys = np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *(k.ravel() for k, _ in coded)]))
    parts, first = [], 0
    for chain, space, (codes, other) in zip(chains, spaces, coded, strict=True):
        roles = np.searchsorted(keys, codes)
        parts.append(ChainCells(chain, space, first, roles, other))
        first += chain.nodes * len(space.atoms)
    decoded = [_role(int(key), list(events), predicates, base, arity) for key in keys]
    return tuple(parts), tuple(decoded)


def _codes(
    steps: Sequence[Step], events: Sequence[int], space: AtomSpace, base: int, arity: int
) -> tuple[NDArray[np.int64], Integers]:
    """For every step and atom a number that tells its role, and the object that is no argument."""
    index, objects = space.index, len(space.objects)
    place = np.zeros((len(steps), objects + 1), dtype=np.int64)
    for row, step in enumerate(steps):
        place[row, index.numbers(step.arguments)] = np.arange(1, len(step.arguments) + 1)
    terms = np.full((len(space.atoms), arity), objects, dtype=np.intp)
    for row, atom in enumerate(space.atoms):
        terms[row, : len(atom.terms)] = index.numbers(atom.terms)
    names = {p.name: n for n, p in enumerate(space.predicates)}
    predicate = np.array([names[a.predicate] for a in space.atoms], dtype=np.int64)
    found = place[:, terms]  # (steps, atoms, arity)
    codes = np.array(events, dtype=np.int64)[:, None] * max(1, len(names)) + predicate
    for column in range(arity):
        codes = codes * base + found[:, :, column]
    outside = (found == 0) & (terms < objects)
    single = outside.sum(axis=2) == 1
    other = np.where(single, (outside * terms).sum(axis=2), -1)
    return codes, other.astype(np.intp)


def _role(
    key: int,
    events: Sequence[tuple[StepKind, str]],
    predicates: Sequence[Predicate],
    base: int,
    arity: int,
) -> Role:
    terms: list[int] = []
    for _ in range(arity):
        key, place = divmod(key, base)
        terms.insert(0, place - 1)
    event, predicate = divmod(key, max(1, len(predicates)))
    own = tuple(terms[: predicates[predicate].arity])
    return Role(*events[event], predicate, own)

"""Conditions that the rule of a role may hang on: atoms over arguments and the role's object."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from skillwrapper.grounding import AtomSpace
from skillwrapper.grounding.atom_index import LiftedAtom
from skillwrapper.perception.decoding.cells import OTHER, Cells, ChainCells, Integers, Role
from skillwrapper.symbols import Predicate


class Conditions:
    """Finds the variables of conditions.

    Args:
        cells: the cells.
        context: predicates that are decoded already; their variables are numbered after those of
            the cells, chain by chain, node by node.
    """

    def __init__(self, cells: Cells, context: Sequence[Predicate]) -> None:
        self._cells = cells
        self._predicates = (*cells.predicates, *context)
        self._spaces = [AtomSpace(self._predicates, p.chain.scene.objects) for p in cells.parts]
        self._first_context: list[int] = []
        first = cells.variables
        for part, space in zip(cells.parts, self._spaces, strict=True):
            self._first_context.append(first)
            first += part.chain.nodes * (len(space.atoms) - len(part.space.atoms))
        self._known: dict[int, Integers] = {}

    def candidates(self, role: Role) -> tuple[LiftedAtom, ...]:
        """Atoms over the arguments; over the role's own other object too, if it has one.

        None for a role with more than one: there are too many to learn from so little.
        """
        if role.others > 1:
            return ()
        arity = self._arity(role)
        places = range(arity + role.others)
        own = tuple(arity if t == OTHER else t for t in role.terms)
        return tuple(
            (predicate.name, terms)
            for predicate in self._predicates
            for terms in itertools.permutations(places, predicate.arity)
            if (not role.others or arity in terms)
            and (predicate.name, terms) != (self._name(role), own)
        )

    def variables(self, number: int) -> Integers:
        """The variables (cells, candidates) of the conditions of a role's cells; -1 for none."""
        if number not in self._known:
            self._known[number] = self._find(number)
        return self._known[number]

    def _name(self, role: Role) -> str:
        return self._predicates[role.predicate].name

    def _arity(self, role: Role) -> int:
        steps = (s for part in self._cells.parts for s in part.chain.steps)
        return next(len(s.arguments) for s in steps if (s.kind, s.skill) == (role.kind, role.skill))

    def _find(self, number: int) -> Integers:
        cells, role = self._cells, self._cells.roles[number]
        own, candidates = cells.slices[number], self.candidates(role)
        found = np.full((own.stop - own.start, len(candidates)), -1, dtype=np.intp)
        for place, part in enumerate(cells.parts):
            rows = np.flatnonzero(cells.part[own] == place)
            if len(rows):
                at = own.start + rows
                columns = self._columns(place, role, candidates, cells.step[at], cells.atom[at])
                node = (cells.before[at] - part.first) // len(part.space.atoms)
                found[rows] = self._variables(place, part, node, columns)
        return found

    def _columns(
        self,
        place: int,
        role: Role,
        candidates: Sequence[LiftedAtom],
        steps: Integers,
        atoms: Integers,
    ) -> Integers:
        """Columns (cells, candidates) in the space of the chain."""
        part, index = self._cells.parts[place], self._spaces[place].index
        pairs, which = np.unique(np.stack([steps, atoms], axis=1), axis=0, return_inverse=True)
        bindings = np.array(
            [
                [*index.numbers(part.chain.steps[s].arguments), *[part.other[s, a]] * role.others]
                for s, a in pairs.tolist()
            ],
            dtype=np.intp,
        )
        patterns = index.patterns(candidates, self._arity(role) + role.others)
        columns: Integers = index.columns(patterns, bindings)[which.ravel()]
        return columns

    def _variables(
        self, place: int, part: ChainCells, node: Integers, columns: Integers
    ) -> Integers:
        atoms = len(part.space.atoms)
        extra = len(self._spaces[place].atoms) - atoms
        own = part.first + node[:, None] * atoms + columns
        context = self._first_context[place] + node[:, None] * extra + columns - atoms
        return np.where(columns < 0, -1, np.where(columns < atoms, own, context))

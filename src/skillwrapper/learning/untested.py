"""Conditions that may not be needed: nothing was ever tried where one of them alone is unmet.

A precondition is what held before every transition of a cluster. Only a transition outside the
cluster that meets everything else shows that a condition matters. The other conditions are where
the most specific and the most general precondition differ (section 10), and so what is
worth trying.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.grounding.ground import absent_atoms
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.symbols import Operator, Variable
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object


def find_untested(fit: Fit) -> dict[str, frozenset[Condition]]:
    """For every operator, by name, the conditions that no transition has put to the test."""
    signatures = {p.name: p.types for p in fit.predicates}
    return {
        learned.operator.name: _untested(fit.domain, signatures, learned, of_skill.predictions)
        for of_skill in fit.skills.values()
        for learned in of_skill.operators
    }


def _untested(
    domain: Domain,
    signatures: Mapping[str, tuple[str, ...]],
    learned: LearnedOperator,
    predictions: Sequence[TablePrediction],
) -> frozenset[Condition]:
    operator = learned.operator
    narrowed = _narrowed(domain, signatures, operator)
    left: set[Condition] = {*operator.preconditions, *operator.absences, *narrowed}
    for prediction in predictions:
        for needs, states in _attempts(learned, narrowed, prediction):
            left -= _alone_unmet(needs, states)
    return frozenset(left)


def _narrowed(
    domain: Domain, signatures: Mapping[str, tuple[str, ...]], operator: Operator
) -> tuple[Variable, ...]:
    """The parameters whose types are a condition of their own.

    That is more than the skill asks for, or than the literals that bind a context parameter do.
    """
    skill = domain.skill_by_name[operator.skill]
    implied = {
        v.name: {p.type} for v, p in zip(operator.parameters, skill.parameters, strict=False)
    }
    positive = [literal.atom for literal in operator.preconditions if literal.positive]
    for atom in (*positive, *operator.add_effects, *operator.delete_effects):
        for term, type_name in zip(atom.terms, signatures[atom.predicate], strict=True):
            implied.setdefault(term, set()).add(type_name)
    return tuple(
        v
        for v in operator.parameters
        if not domain.types.closure(implied.get(v.name, ())).issuperset(v.types)
    )


def _attempts(
    learned: LearnedOperator, narrowed: Sequence[Variable], prediction: TablePrediction
) -> Iterator[tuple[dict[Condition, _Need], Labels]]:
    """What each condition asks for under a binding, and the states where it was not fulfilled."""
    table = prediction.table
    applies = np.zeros(len(table), dtype=bool)
    for operator, found in zip(prediction.operators, prediction.applications, strict=True):
        if operator is learned:
            applies[found.rows[found.applicability != FALSE]] = True
    for number, instance in enumerate(table.instances):
        rows = np.flatnonzero((table.which == number) & ~applies)
        if len(rows):
            before = np.unique(table.before[rows], axis=0)
            for binding in _bindings(learned.operator, narrowed, instance, table.space):
                yield _required(learned.operator, narrowed, binding, table.space), before


def _bindings(
    operator: Operator, narrowed: Sequence[Variable], instance: SkillInstance, space: AtomSpace
) -> Iterator[dict[str, Object]]:
    """Bindings to distinct objects; at most one of them is not of the types it should have."""
    known = {o.name: o for o in space.objects}
    choices: list[tuple[Object, ...]] = [(known[name],) for name in instance.arguments]
    choices += [
        tuple(o for o in space.objects if v in narrowed or o.has_types(v.types))
        for v in operator.context
    ]
    for chosen in itertools.product(*choices):
        pairs = list(zip(operator.parameters, chosen, strict=True))
        wrong = sum(not o.has_types(v.types) for v, o in pairs)
        if wrong <= 1 and len(set(chosen)) == len(chosen):
            yield {v.name: o for v, o in pairs}


def _required(
    operator: Operator,
    narrowed: Sequence[Variable],
    binding: Mapping[str, Object],
    space: AtomSpace,
) -> dict[Condition, _Need]:
    names = {variable: o.name for variable, o in binding.items()}
    needs: dict[Condition, _Need] = {}
    for literal in operator.preconditions:
        column = space.column.get(literal.atom.substitute(names))
        # An atom that is no grounding (wrong types) is false in every state.
        hopeless = literal.positive and column is None
        needs[literal] = _Need(() if column is None else (column,), literal.positive, hopeless)
    for absence in operator.absences:
        columns = tuple(space.column[a] for a in absent_atoms(absence, names, space))
        needs[absence] = _Need(columns, positive=False)
    for variable in narrowed:
        fits = binding[variable.name].has_types(variable.types)
        needs[variable] = _Need((), positive=False, hopeless=not fits)
    return needs


@dataclass(frozen=True)
class _Need:
    """A condition under a binding.

    Attributes:
        columns: of the labels that it is about.
        positive: whether they must be true, or else false.
        hopeless: whether it is unmet whatever the labels are.
    """

    columns: tuple[int, ...]
    positive: bool
    hopeless: bool = False

    def met(self, states: Labels) -> Labels:
        """TRUE, FALSE or UNKNOWN in every state (n,)."""
        if self.hopeless:
            return np.full(len(states), FALSE, dtype=np.int8)
        values = states[:, list(self.columns)]
        wanted, other = (TRUE, FALSE) if self.positive else (FALSE, TRUE)
        met = np.where((values == wanted).all(axis=1), TRUE, UNKNOWN)
        return np.where((values == other).any(axis=1), FALSE, met).astype(np.int8)


def _alone_unmet(needs: Mapping[Condition, _Need], states: Labels) -> set[Condition]:
    """The conditions that in some state are surely unmet while all others are surely met."""
    met = np.stack([need.met(states) for need in needs.values()])
    lonely = ((met != TRUE).sum(axis=0) == 1) & ((met == FALSE).sum(axis=0) == 1)
    conditions = list(needs)
    return {conditions[i] for i in np.flatnonzero((met[:, lonely] == FALSE).any(axis=1))}

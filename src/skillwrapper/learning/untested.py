"""Conditions that may not be needed: nothing was ever tried where one of them alone is unmet.

A precondition is what held before every transition of a cluster. Only a transition outside the
cluster that meets everything else shows that a condition matters. The other conditions are where
the most specific and the most general precondition differ (``version_space``), and so what is
worth trying.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE
from skillwrapper.grounding.bindings import Attempts, Bindings
from skillwrapper.grounding.indexed_operators import IndexedOperator
from skillwrapper.grounding.joins import find_bindings
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction, attempts_of
from skillwrapper.symbols import Operator, Variable
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.domain import Domain

_ENOUGH = 1 << 20
"""Of an operator that nothing ties down, so many bindings are looked at; a condition that these do
not put to the test counts as untested."""


def find_untested(fit: Fit) -> dict[str, frozenset[Condition]]:
    """For every operator, by name, the conditions that no transition has put to the test."""
    signatures = {p.name: p.types for p in fit.predicates}
    return {
        learned.operator.name: _untested(fit.domain, signatures, learned, of_skill.predictions)
        for of_skill in fit.skills.values()
        for learned in of_skill.operators
    }


def find_tests(fit: Fit, learned: LearnedOperator) -> dict[Condition, tuple[int, ...]]:
    """What puts the conditions of an operator to the test.

    Returns:
        For each condition the numbers of the transitions in which the operator does not apply for
        want of this condition alone, in order of time; none for one that is untested.
    """
    signatures = {p.name: p.types for p in fit.predicates}
    predictions = fit.skill(learned.operator.skill).predictions
    tests = _tests(fit.domain, signatures, learned, predictions)
    return {condition: tuple(sorted(found)) for condition, found in tests.items()}


def _untested(
    domain: Domain,
    signatures: Mapping[str, tuple[str, ...]],
    learned: LearnedOperator,
    predictions: Sequence[TablePrediction],
) -> frozenset[Condition]:
    tests = _tests(domain, signatures, learned, predictions)
    return frozenset(condition for condition, found in tests.items() if not found)


def _tests(
    domain: Domain,
    signatures: Mapping[str, tuple[str, ...]],
    learned: LearnedOperator,
    predictions: Sequence[TablePrediction],
) -> dict[Condition, set[int]]:
    operator = learned.operator
    narrowed = frozenset(narrowed_types(domain, signatures, operator))
    conditions: tuple[Condition, ...] = (
        *operator.preconditions,
        *operator.absences,
        *narrowed,
    )
    tests: dict[Condition, set[int]] = {condition: set() for condition in conditions}
    for prediction in predictions:
        indexed = IndexedOperator(operator, prediction.table.space, narrowed)
        attempts, patience = _unfulfilled(learned, prediction), _Patience()
        for bindings in find_bindings(indexed, attempts, most_unmet=1, wanted=patience):
            alone = bindings.select((bindings.unmet == 1) & ~bindings.unsure)
            for row, number in np.argwhere(alone.met() == FALSE).tolist():
                transition = int(prediction.table.ids[alone.rows[row]])
                tests[indexed.conditions[number]].add(transition)
    return tests


class _Patience:
    """Goes on with what hangs on no unknown label, as long as it is not too much."""

    def __init__(self) -> None:
        self._seen = 0

    def __call__(self, bindings: Bindings) -> NDArray[np.bool_]:
        self._seen += len(bindings)
        going_on: NDArray[np.bool_] = ~bindings.unsure & (self._seen <= _ENOUGH)
        return going_on


def _unfulfilled(learned: LearnedOperator, prediction: TablePrediction) -> Attempts:
    """The transitions where an operator does not apply."""
    table = prediction.table
    other = np.ones(len(table), dtype=bool)
    for operator, found in zip(prediction.operators, prediction.applications, strict=True):
        if operator is learned:
            other[found.possible] = False
    return attempts_of(table, np.flatnonzero(other))


def narrowed_types(
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

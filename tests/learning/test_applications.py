"""What operators say of transitions, all at once and one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from hypothesis import given
from notebook import Notebook, make_domain
from numpy.typing import NDArray
from random_worlds import QUICK, notebooks
from scalar_grounding import ScalarOperator, ground_operator

from skillwrapper.grounding import FALSE, TRUE
from skillwrapper.grounding.bindings import Bindings
from skillwrapper.learning.certification import certify
from skillwrapper.learning.predictions import Application, attempts_of
from skillwrapper.learning.untested import find_untested
from skillwrapper.symbols import Atom, ConditionalEffect, Literal, Operator, Predicate, Variable
from skillwrapper.transitions.tables import SkillTable


@dataclass
class Expected:
    """Rows of a table, found by binding an operator to one object after the other."""

    possible: set[int] = field(default_factory=set)
    sure: set[int] = field(default_factory=set)
    accounted: set[int] = field(default_factory=set)
    mispredicted: set[int] = field(default_factory=set)
    similar: set[int] = field(default_factory=set)


def expected(operator: Operator, table: SkillTable) -> Expected:
    found = Expected()
    for ground in ground_operator(operator, table.space):
        for row, which in enumerate(table.which):
            if table.instances[which] == ground.instance:
                note(found, ground, table, row)
    return found


def note(found: Expected, ground: ScalarOperator, table: SkillTable, row: int) -> None:
    state = table.before[[row]]
    verdict, effect = ground.applicability(state)[0], ground.effects(state)[0]
    whole = (effect == table.change[row]) | table.undetermined[row]
    right = ground.apply(state)[0] == table.after[row]
    right |= table.undetermined[row] | table.unexplained[row]
    if whole.all():
        found.similar.add(row)
    if verdict != FALSE:
        found.possible.add(row)
    if verdict == TRUE:
        found.sure.add(row)
        if whole.all():
            found.accounted.add(row)
        if not right.all() and table.success[row] and not table.hanging[row]:
            found.mispredicted.add(row)


def operators(notebook: Notebook) -> Iterator[tuple[Operator, SkillTable]]:
    """What is learned, as it is and with conditional effects."""
    for fit in notebook.fit().skills.values():
        for prediction in fit.predictions:
            for learned in prediction.operators:
                operator = learned.operator
                yield operator, prediction.table
                effects = frozenset(conditional(operator))
                yield replace(operator, conditional_effects=effects), prediction.table


def conditional(operator: Operator) -> Iterator[ConditionalEffect]:
    """Whatever does, or does not, lie on a parameter becomes clean and dark."""
    each = Variable("?each", ("thing",))
    clean = Literal(Atom("clean", ("?each",)), positive=False)
    for parameter in operator.parameters:
        on = Atom("on", ("?each", parameter.name))
        yield ConditionalEffect(each, (Literal(on),), clean)
        yield ConditionalEffect(each, (Literal(on, positive=False),), Literal(Atom("dark", ())))


@QUICK
@given(notebooks(unknowns=True))
def test_what_operators_say_of_transitions(notebook: Notebook) -> None:
    for operator, table in operators(notebook):
        found = Application.of(operator, table, attempts_of(table))
        wanted = expected(operator, table)
        assert set(found.possible) == wanted.possible
        assert set(found.sure) == wanted.sure
        assert set(found.accounted) == wanted.accounted
        assert set(found.mispredicted) == wanted.mispredicted
        assert set(found.similar) >= wanted.similar
        if all(v.name in terms_of_effects(operator) for v in operator.context):
            assert set(found.similar) == wanted.similar  # else it asks for less


def terms_of_effects(operator: Operator) -> set[str]:
    return {t for a in operator.add_effects | operator.delete_effects for t in a.terms}


def test_wrong_labels_do_not_multiply_bindings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Flipped labels make an operator with eight parameters over twelve blocks.

    Its bindings to all of them would be 1.6 million for every transition.
    """
    blocks = make_domain({"block": ()}, {f"b{n}": "block" for n in range(12)}, {"Lift": "block"})
    notebook = Notebook(blocks, Predicate("on", ("block", "block")), Predicate("up", ("block",)))
    chain = " ".join(f"on(b{n}, b{n + 1})" for n in range(7))
    for again in ("", "#2"):  # seen once, it would be no operator
        notebook.success(f"{chain} {again}", "Lift(b0)", "up(b0)")  # all relations are gone
    for n in range(12):
        other = " ".join(f"on(b{m}, b{(m + n) % 11 + 1})" for m in range(0, n, 2))
        notebook.success(other, f"Lift(b{n})", f"{other} up(b{n})")
        notebook.failure(f"{chain} up(b{n})", f"Lift(b{n})")
    looked_at = 0
    select = Bindings.select

    def counting(self: Bindings, chosen: NDArray[np.bool_] | slice) -> Bindings:
        nonlocal looked_at
        looked_at += len(self)
        return select(self, chosen)

    monkeypatch.setattr(Bindings, "select", counting)
    fit = notebook.fit()
    assert max(len(o.operator.parameters) for o in fit.operators) == 8
    certify(fit)
    find_untested(fit)
    assert looked_at < 100_000

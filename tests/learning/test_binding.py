"""Operators bound all at once mean what they mean bound one after the other."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from notebook import Notebook
from random_worlds import QUICK, notebooks

from skillwrapper.grounding import ground_operator
from skillwrapper.learning import binding
from skillwrapper.learning.binding import bind_operator
from skillwrapper.symbols import Atom, ConditionalEffect, Literal, Operator, Variable
from skillwrapper.transitions.tables import SkillTable

Verdict = tuple[int, int, bytes]
"""Row, applicability and effect of a ground operator."""


def one_after_the_other(operator: Operator, table: SkillTable) -> Counter[Verdict]:
    """Of all ground operators whose skill instance is that of the transition."""
    found: Counter[Verdict] = Counter()
    for ground in ground_operator(operator, table.space):
        for row, which in enumerate(table.which):
            if table.instances[which] == ground.instance:
                state = table.before[[row]]
                effect = ground.effects(state)[0].tobytes()
                found[row, int(ground.applicability(state)[0]), effect] += 1
    return found


def all_at_once(operator: Operator, table: SkillTable) -> Counter[Verdict]:
    bound = bind_operator(operator, table)
    which, rows = bound.pairs()
    verdicts = bound.applicability(which, rows).tolist()
    effects = (effect.tobytes() for effect in bound.effects(which, rows))
    return Counter(zip(rows.tolist(), verdicts, effects, strict=True))


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
def test_bindings_are_those_of_ground_operators(notebook: Notebook) -> None:
    for operator, table in operators(notebook):
        assert all_at_once(operator, table) == one_after_the_other(operator, table)


@QUICK
@given(notebooks(unknowns=True), st.integers(1, 5))
def test_the_size_of_the_blocks_does_not_matter(notebook: Notebook, size: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        for operator, table in operators(notebook):
            bound = bind_operator(operator, table)
            which, rows = bound.pairs()
            excused = table.undetermined | table.unexplained
            found = []
            for block in (10_000, size):
                patch.setattr(binding, "_BLOCK", block)
                found.append(
                    [
                        bound.applicability(which, rows),
                        bound.makes_change(which, rows),
                        bound.mispredicts(which, rows, excused),
                    ]
                )
            assert all(np.array_equal(a, b) for a, b in zip(*found, strict=True))

"""Clusters of successes by lifted change."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from hypothesis import given
from notebook import Notebook, make_domain
from random_worlds import QUICK, notebooks

from skillwrapper.grounding import UNKNOWN
from skillwrapper.learning.clusters import (
    cluster_successes,
)
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.lifting import lift_change

KITCHEN = make_domain(
    types={"robot": (), "item": (), "place": ()},
    objects={"r": "robot", "a": "item", "b": "item", "x": "place", "y": "place"},
    skills={"Take": "robot item"},
)
HOLDS = Predicate("holds", ("robot", "item"))
ON = Predicate("on", ("item", "place"))
FREE = Predicate("free", ("place",))


def kitchen() -> Notebook:
    return Notebook(KITCHEN, HOLDS, ON, FREE)


@QUICK
@given(notebooks(unknowns=True))
def test_groups_are_those_of_brute_force(notebook: Notebook) -> None:
    for skill in notebook.domain.skills:
        for table in notebook.data(skill.name):
            expected = defaultdict(list)
            for row, change in enumerate(table.change):
                expected[table.which[row], change.tobytes()].append(row)
            found = [g.rows.tolist() for g in table.group(np.ones(len(table), bool))]
            assert found == list(expected.values())


@QUICK
@given(notebooks())
def test_clusters_share_a_lifted_change_and_hold_every_success_once(notebook: Notebook) -> None:
    for skill in notebook.domain.skills:
        data = notebook.data(skill.name)
        clusters = cluster_successes(data)
        assert [c.change for c in clusters] == sorted({c.change for c in clusters})
        numbers = [int(i) for table in data for i in table.ids[table.success]]
        assert sorted(i for c in clusters for i in c.ids) == sorted(numbers)
        for cluster in clusters:
            for group in cluster.groups:
                row = group.rows[0]
                literals = group.table.changed_literals(int(row))
                lifting = lift_change(literals, group.instance.arguments)
                assert lifting.change == cluster.change


def test_the_order_of_the_data_does_not_matter() -> None:
    steps = [
        ("on(a, x)", "Take(r, a)", "holds(r, a) free(x)"),
        ("on(b, y)", "Take(r, b)", "holds(r, b) free(y)"),
        ("free(x)", "Take(r, a)", "holds(r, a) free(x)"),
    ]
    notebook, other = kitchen(), kitchen()
    for step in steps:
        notebook.success(*step)
    for step in reversed(steps):
        other.success(*step)
    clusters = cluster_successes(notebook.data("Take"))
    assert [c.ids for c in clusters] == [[0, 1], [2]]
    assert [c.change for c in clusters] == [c.change for c in cluster_successes(other.data("Take"))]


def test_unknown_labels_of_other_things_are_no_matter() -> None:
    notebook = kitchen()
    notebook.success("on(a, x)", "Take(r, a)", "holds(r, a) free(x) ?free(y)")
    (table,) = notebook.data("Take")
    assert (table.after == UNKNOWN).sum() == 1
    assert not table.hanging.any()


def test_a_success_with_an_unknown_change_founds_no_cluster() -> None:
    """D10: of an argument, and of what the change reaches."""
    notebook = kitchen()
    notebook.success("on(a, x)", "Take(r, a)", "?holds(r, a) free(x)")
    notebook.success("on(a, x)", "Take(r, a)", "holds(r, a) ?free(x)")
    (table,) = notebook.data("Take")
    assert table.hanging.tolist() == [True, True]
    assert cluster_successes(notebook.data("Take")) == ()


def test_no_inconsistency_rests_on_an_unknown_label() -> None:
    """Were ``free(x)`` taken for unchanged, the second success would contradict the first."""
    notebook = kitchen()
    for _ in range(2):
        notebook.success("on(a, x)", "Take(r, a)", "holds(r, a) free(x)")
    notebook.success("on(b, y)", "Take(r, b)", "holds(r, b) ?free(y)")
    notebook.success("on(b, y)", "Take(r, b)", "on(b, y) ?holds(r, b)")
    assert notebook.fit().inconsistencies == ()
    notebook.success("on(b, y)", "Take(r, b)", "holds(r, b)")
    assert {i.kind for i in notebook.fit().inconsistencies} == {InconsistencyKind.DETERMINISM}

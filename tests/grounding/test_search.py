"""Searching and simulating in a small model of two doors."""

from __future__ import annotations

import numpy as np
import pytest
from garden import GARDEN, MODEL, OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT, SPACE, operator, state

from skillwrapper.grounding import UNKNOWN, GroundModel
from skillwrapper.grounding.ground_operators import follow, reachable_operators
from skillwrapper.grounding.search import BreadthFirst, StateGraph, is_reachable
from skillwrapper.grounding.simulation import simulate

GROUND = GroundModel.of(MODEL, GARDEN.objects)
ONLY_OPENS = GroundModel.from_operators([operator("Open", opens=True)], SPACE)


def test_layers_are_distances() -> None:
    graph = StateGraph(GROUND, limit=100)
    layers = list(BreadthFirst(graph, state(0, 0)).layers())
    assert [graph.states(layer).sum(axis=1).tolist() for layer in layers] == [[0], [1, 1], [2]]


def test_a_path_leads_where_it_says() -> None:
    graph = StateGraph(GROUND, limit=100)
    search = BreadthFirst(graph, state(1, 0))
    *_, last = search.layers()
    (node,) = last
    path = search.path_to(node)
    assert set(path) == {SHUT_LEFT, OPEN_RIGHT}
    end = simulate(GROUND, state(1, 0), path).states[-1]
    assert end.tolist() == graph.states([node])[0].tolist() == [0, 1]


@pytest.mark.parametrize(
    ("start", "goal", "reachable"),
    [((0, 0), (0, 0), True), ((0, 0), (1, 1), True), ((1, 0), (0, 1), False)],
)
def test_reachability(start, goal, reachable) -> None:
    assert is_reachable(StateGraph(ONLY_OPENS, 100), state(*start), state(*goal)) is reachable


def test_a_search_that_ends_early_says_nothing() -> None:
    assert is_reachable(StateGraph(GROUND, 1), state(0, 0), state(1, 1)) is None


def test_a_graph_remembers_what_it_expanded(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = StateGraph(GROUND, 100)
    assert is_reachable(graph, state(0, 0), state(1, 1))
    list(BreadthFirst(graph, state(0, 0)).layers())
    monkeypatch.setattr(GroundModel, "bind_all", None)
    assert len(list(BreadthFirst(graph, state(1, 0)).layers())) == 3


def test_simulation_notes_failures_and_goes_on() -> None:
    found = simulate(GROUND, state(0, UNKNOWN), [SHUT_LEFT, OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT])
    assert found.succeeds.tolist() == [False, True, False, True]
    assert found.states[:, 0].tolist() == [0, 0, 1, 1, 0]


def test_operators_that_can_never_apply_are_left_out() -> None:
    """Nothing shuts a door, so that of an open one nothing is to be said."""
    assert len(reachable_operators(GROUND, state(0, 0))) == 4
    assert [g.instance for g in reachable_operators(ONLY_OPENS, state(1, 0))] == [OPEN_RIGHT]
    assert reachable_operators(ONLY_OPENS, state(1, 1)) == ()


def test_following_ground_operators() -> None:
    left, right = reachable_operators(ONLY_OPENS, state(0, 0))
    end = follow([left, right], state(0, 0))
    assert end is not None
    assert np.array_equal(end, state(1, 1))
    assert follow([left, left], state(0, 0)) is None
    assert follow([], state(0, 1)) is not None

"""What is within reach, and what was done with the objects on the way."""

from __future__ import annotations

import numpy as np
import pytest
from garden import GARDEN, MODEL, OPEN_LEFT, OPEN_RIGHT, SEEN, SHUT_LEFT, SHUT_RIGHT, state
from notebook import make_domain

from skillwrapper.exploration.lookahead import Lookahead, look_ahead
from skillwrapper.exploration.memory import Memory, Surprises
from skillwrapper.exploration.roles import UNTOUCHED, RoleNumbers, SceneRoles
from skillwrapper.grounding import GroundModel
from skillwrapper.grounding.search import StateGraph
from skillwrapper.world import Transition

GROUND = GroundModel.of(MODEL, GARDEN.objects)
SCENE = SceneRoles(GARDEN, GARDEN.scene(), RoleNumbers())
OPENED, SHUT = 0, 1
"""The roles of a door: both skills have one argument."""


def reach(depth: int, most: int = 100) -> Lookahead:
    graph = StateGraph(GROUND, 1000)
    return look_ahead(graph, state(0, 0), SCENE.at_start, SCENE, depth=depth, most=most)


def test_the_present_comes_first_then_what_is_one_step_away() -> None:
    found = reach(1)
    assert found.depth.tolist() == [0, 1, 1]
    assert found.path(0) == []
    assert {SCENE.instances[found.path(n)[0]] for n in (1, 2)} == {OPEN_LEFT, OPEN_RIGHT}
    left = next(n for n in (1, 2) if SCENE.instances[found.path(n)[0]] == OPEN_LEFT)
    assert found.states[found.state[left]].tolist() == [1, 0]
    assert found.roles[left].tolist() == [OPENED, UNTOUCHED]


def test_the_same_state_after_other_deeds_is_another_node() -> None:
    found = reach(2)
    rows = {
        (tuple(found.states[s]), tuple(r)) for s, r in zip(found.state, found.roles, strict=True)
    }
    assert len(rows) == len(found.state)
    assert ((0, 0), (SHUT, UNTOUCHED)) in rows
    assert ((0, 0), (UNTOUCHED, UNTOUCHED)) in rows


def test_what_surely_works_is_known_of_every_state() -> None:
    found = reach(2)
    for row, works in zip(found.states, found.sure, strict=True):
        possible = {SCENE.instances[n] for n in np.flatnonzero(works)}
        assert (OPEN_LEFT in possible, SHUT_LEFT in possible) == (row[0] == 0, row[0] == 1)
        assert (OPEN_RIGHT in possible, SHUT_RIGHT in possible) == (row[1] == 0, row[1] == 1)


@pytest.mark.parametrize("most", [1, 2, 5])
def test_there_are_never_more_nodes_than_asked_for(most: int) -> None:
    assert len(reach(9, most).state) == most


def test_arguments_of_every_instance_have_no_role() -> None:
    domain = make_domain(
        {"hand": (), "cup": ()}, {"h": "hand", "a": "cup", "b": "cup"}, {"Stack": "hand cup cup"}
    )
    scene = SceneRoles(domain, domain.scene(), RoleNumbers())
    assert [places.tolist() for places in scene.places] == [[1, 2], [2, 1]]
    after = scene.after(scene.at_start, 0)
    assert after[0] == UNTOUCHED
    assert after[1] != after[2]
    assert scene.signature(after, 1) == (after[2], after[1])


def test_new_roles_are_those_that_no_failure_had() -> None:
    memory, scene = Memory(GARDEN), GARDEN.scene()
    memory.start(scene)
    memory.note(scene, Transition(SEEN, SHUT_LEFT, False, SEEN), predicted=None)
    memory.note(scene, Transition(SEEN, OPEN_LEFT, True, SEEN), predicted=None)
    roles, places = np.array([[UNTOUCHED, 0], [memory.roles[0], 0]]), np.array([0])
    assert memory.new_roles("Shut", roles, places).tolist() == [0.0, 1.0]
    assert memory.new_signatures(memory.seen["Shut"], roles, places).tolist() == [False, True]
    assert memory.signatures == [(UNTOUCHED,), (UNTOUCHED,)]
    assert memory.was_tried(SEEN.key, b"", SHUT_LEFT)
    assert not memory.was_tried(SEEN.key, b"", SHUT_RIGHT)


def test_what_failed_since_anything_succeeded_is_known_though_pictures_never_repeat() -> None:
    memory, scene = Memory(GARDEN), GARDEN.scene()
    memory.start(scene)
    memory.note(scene, Transition(SEEN, SHUT_LEFT, False, SEEN), state=b"both shut")
    assert memory.has_failed("another picture", b"both shut", SHUT_LEFT)
    assert not memory.has_failed("another picture", b"one open", SHUT_LEFT)
    memory.note(scene, Transition(SEEN, OPEN_RIGHT, True, SEEN), state=b"both shut")
    assert not memory.has_failed("another picture", b"both shut", SHUT_LEFT)


def test_surprises_fade() -> None:
    surprises = Surprises()
    rates = [surprises.rate(predicted=True)]
    for success in (True, True, False, True):
        surprises.note(predicted=True, success=success)
        rates.append(surprises.rate(predicted=True))
    assert rates[0] > rates[1] > rates[2] < rates[3] > rates[4]
    assert surprises.rate(predicted=False) == rates[0]

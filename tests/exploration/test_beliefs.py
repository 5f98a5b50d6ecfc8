"""What is expected of attempts, beyond whether they work."""

from __future__ import annotations

import numpy as np
from house import HOUSE, SCENE, House

from skillwrapper.exploration.beliefs import Beliefs, Expectations
from skillwrapper.grounding import AtomSpace
from skillwrapper.world import SkillInstance

INSTANCES = tuple(sorted(set(HOUSE.skill_instances)))


def expect(house: House, *states: str) -> Expectations:
    fit = house.notebook.fit()
    space = AtomSpace(fit.predicates, SCENE.objects)
    rows = [[str(atom) in state for atom in space.atoms] for state in states]
    labels = np.array(rows, dtype=np.int8)
    return Beliefs().expect(fit, space, labels, INSTANCES, doubt=0.01)


def place(skill: str, *arguments: str) -> int:
    return INSTANCES.index(SkillInstance(skill, arguments))


def test_other_objects_are_untried_where_the_same_is_seen_of_them() -> None:
    """What tells them apart may have no name yet."""
    house = House()
    house.run(INSTANCES[place("Tie", "h", "front", "back")])
    house.run(INSTANCES[place("Open", "h", "front")])
    house.run(INSTANCES[place("Tie", "h", "front", "lamp")])
    found = expect(house, "", "open(front)")
    tried, other = place("Tie", "h", "front", "back"), place("Tie", "h", "back", "front")
    assert found.untried[:, tried].tolist() == [0.0, 1.0]
    assert found.untried[:, other].tolist() == [1.0, 1.0]
    assert found.pairs[0, tried] == found.pairs[0, other] == 0.0


def test_what_succeeded_may_have_more_to_act_on_where_other_things_hold() -> None:
    house = House()
    house.state = "open(front)"
    house.run(INSTANCES[place("Open", "h", "front")])
    house.run(INSTANCES[place("Open", "h", "back")])
    found = expect(house, "open(front)", "open(front) open(back) airy()")
    same, other = found.unlike[:, place("Open", "h", "front")].tolist()
    assert same == 0.0 < other < 1.0
    assert found.unlike[0, place("Light", "h", "lamp")] == 1.0  # never done


def test_what_failed_may_work_where_other_things_hold() -> None:
    house = House()
    house.run(INSTANCES[place("Open", "h", "front")])
    house.run(INSTANCES[place("Tie", "h", "front", "back")])
    found = expect(house, "open(front)", "open(front) open(back) airy()")
    same, other = found.elsewhere[:, place("Tie", "h", "front", "back")].tolist()
    assert same == 0.0 < other < 1.0
    assert found.elsewhere[0, place("Light", "h", "lamp")] == 1.0  # never done

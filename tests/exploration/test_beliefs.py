"""What is expected of attempts, beyond whether they work."""

from __future__ import annotations

import numpy as np
from house import HOUSE, SCENE, House
from notebook import Notebook
from pottery import POTTERY, WORDS

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


def test_arguments_of_other_types_may_work_where_all_holds_that_the_skill_needs() -> None:
    """Who is put on the wheel takes it; a shelf is never taken: no operator can say both."""
    notebook = Notebook(POTTERY, *WORDS)
    wheel = "free(p) at(red, wheel) taken(wheel) at(grey, shelf)"
    notebook.success("holds(p, red) at(grey, shelf)", "Put(p, red, wheel)", wheel)
    instances = tuple(sorted(POTTERY.skill_instances))
    number = instances.index(SkillInstance("Put", ("p", "red", "shelf")))

    def chances() -> list[float]:
        fit = notebook.fit()
        space = AtomSpace(fit.predicates, POTTERY.objects)
        states = ("holds(p, red) at(grey, shelf)", "free(p) at(red, shelf) at(grey, shelf)")
        rows = [[str(atom) in state for atom in space.atoms] for state in states]
        labels = np.array(rows, dtype=np.int8)
        found = Beliefs().expect(fit, space, labels, instances, doubt=0.01)
        return [float(value) for value in found.success[:, number]]

    assert chances() == [1 / 2, 0.0]
    notebook.failure("free(p) at(red, shelf) at(grey, shelf)", "Put(p, red, shelf)")
    assert chances() == [1 / 2, 0.0]  # it failed where what it needs does not hold
    notebook.failure("holds(p, red) at(grey, shelf)", "Put(p, red, shelf)")
    assert chances() == [1 / 3, 0.0]

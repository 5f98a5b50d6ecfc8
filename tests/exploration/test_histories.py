"""What was done with objects, and attempts after what was never done with them before."""

from __future__ import annotations

import numpy as np
from garden import GARDEN, MODEL, OPEN_LEFT, SHUT_LEFT, SPACE, state
from notebook import make_domain

from skillwrapper.exploration.histories import Deeds, Histories, Touched, nearest_unheard
from skillwrapper.exploration.memory import Memory
from skillwrapper.exploration.roles import RoleNumbers, SceneRoles
from skillwrapper.grounding import AtomSpace, GroundModel
from skillwrapper.grounding.search import StateGraph
from skillwrapper.symbols import Predicate
from skillwrapper.world import SkillInstance

SCENE = SceneRoles(GARDEN, GARDEN.scene(), RoleNumbers())
OPENED, SHUT = 1, 2
"""The bits of the skills."""
NOTHING: Deeds = np.zeros(2, dtype=np.int64)


def number(instance: SkillInstance) -> int:
    return SCENE.number[instance]


def way(histories: Histories, deeds: Deeds = NOTHING, depth: int = 5) -> tuple[SkillInstance, ...]:
    """The way to an attempt at Shut that is new."""
    graph = StateGraph(GroundModel.of(MODEL, GARDEN.objects), 1000)
    touched = Touched(SCENE, SPACE, ["Open", "Shut"])
    found = nearest_unheard(
        graph, state(0, 0), deeds, SCENE, touched, histories,
        skills=["Shut"], depth=depth, most=1000,
    )  # fmt: skip
    return tuple(SCENE.instances[n] for n in found)


def tried(*histories: tuple[int, bool]) -> Histories:
    """Histories of Shut: what was done with the door, and whether it was open."""
    found = Histories()
    for deeds, is_open in histories:
        found.note("Shut", ((deeds,), frozenset({("open", (0,))} if is_open else ())))
    return found


def test_a_skill_has_to_do_with_its_arguments_and_with_what_changes() -> None:
    touched = Touched(SCENE, SPACE, ["Open", "Shut"])
    assert touched.by(number(OPEN_LEFT), state(0, 0), state(1, 1)).tolist() == [OPENED, OPENED]
    assert touched.by(number(OPEN_LEFT), state(0, 0), state(1, 0)).tolist() == [OPENED, 0]
    assert touched.by(number(SHUT_LEFT), state(0, 0), state(0, 0)).tolist() == [SHUT, 0]


def test_what_seems_to_change_nothing_has_to_do_with_what_its_arguments_are_related_to() -> None:
    domain = make_domain(
        {"drum": (), "sock": ()},
        {"drum": "drum", "red": "sock", "blue": "sock"},
        {"Spin": "drum", "Stop": "sock"},
    )
    scene = SceneRoles(domain, domain.scene(), RoleNumbers())
    space = AtomSpace(
        (Predicate("inside", ("sock", "drum"), "The sock is inside."),), domain.objects
    )
    labels = np.array([atom.terms[0] == "red" for atom in space.atoms], dtype=np.int8)
    spin = next(n for n, i in enumerate(scene.instances) if i.skill == "Spin")
    for silent, deeds in (((), {"drum"}), (("Spin",), {"drum", "red"})):
        found = Touched(scene, space, ["Spin", "Stop"], silent).by(spin, labels, labels)
        assert {o.name for o, d in zip(space.objects, found, strict=True) if d} == deeds


def test_what_was_never_tried_is_nearest() -> None:
    assert way(Histories())[-1].skill == "Shut"
    assert len(way(Histories())) == 1


def test_another_history_is_sought_where_all_near_ones_were_tried() -> None:
    """First opened, then shut, then opened again: only then it was both, and is open."""
    known = tried((0, False), (OPENED, True), (OPENED | SHUT, False))
    found = way(known)
    assert [i.skill for i in found] == ["Open", "Shut", "Open", "Shut"]
    assert len({i.arguments for i in found}) == 1
    assert way(known, depth=2) == ()
    assert way(tried((0, False), (OPENED, True), (3, False), (3, True))) == ()


def test_deeds_of_this_episode_count() -> None:
    known = tried((0, False), (OPENED, True), (OPENED | SHUT, False))
    assert [i.skill for i in way(known, NOTHING + (OPENED | SHUT))] == ["Open", "Shut"]


def test_hope_wears_off_with_every_history() -> None:
    memory = Memory(GARDEN)
    hopes = []
    for known in range(3):
        memory.histories = tried(*((n, False) for n in range(known)))
        hopes.append(memory.hope_of_history("Shut"))
    assert hopes == sorted(hopes, reverse=True)
    assert hopes[0] == 1

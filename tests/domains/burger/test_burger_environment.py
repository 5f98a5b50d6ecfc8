from __future__ import annotations

import re

import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import HAND, BurgerState
from skillwrapper.domains.burger.style import CHALK
from skillwrapper.domains.burger.system_predicates import SYSTEM_PREDICATES
from skillwrapper.errors import RobotError
from skillwrapper.symbols.predicates import Atom, all_groundings
from skillwrapper.world import Enumerable, SkillInstance, Truthful
from skillwrapper.world.capabilities import supports
from skillwrapper.world.conformance import check_environment

PICK = SkillInstance("Pick", ("robot", "patty"))


@pytest.fixture
def kitchen() -> BurgerEnvironment:
    environment = BurgerEnvironment()
    environment.reset(seed=0)
    return environment


def test_conforms() -> None:
    assert supports(BurgerEnvironment(), Enumerable)
    assert supports(BurgerEnvironment(), Truthful)
    check_environment(BurgerEnvironment, steps=20, sample=3)


def test_skills_are_run_and_failures_explained(kitchen: BurgerEnvironment) -> None:
    assert kitchen.execute(PICK).success
    assert kitchen.get_state().held == "patty"
    again = kitchen.execute(PICK)
    assert not again.success
    assert again.message == "the hand is not empty: it holds the patty"
    assert kitchen.get_state().held == "patty"


def test_layout_is_held_until_the_next_seed(kitchen: BurgerEnvironment) -> None:
    start = kitchen.observe().key
    held = kitchen.execute(PICK).observation.key
    assert kitchen.set_state(BurgerState()).key == start
    assert kitchen.set_state(BurgerState(), seed=1).key != start
    assert kitchen.execute(PICK).observation.key != held


def test_some_call_must_choose_the_layout_first() -> None:
    kitchen = BurgerEnvironment()
    with pytest.raises(RobotError, match="expected reset"):
        kitchen.set_state(BurgerState())
    assert kitchen.set_state(BurgerState(), seed=3).key == kitchen.reset(seed=3).key


def test_style_changes_the_picture_only() -> None:
    classic, chalk = BurgerEnvironment(), BurgerEnvironment(CHALK)
    assert classic.reset(seed=0).key != chalk.reset(seed=0).key
    assert classic.execute(PICK).success
    assert chalk.execute(PICK).success
    assert classic.get_state() == chalk.get_state()


def test_system_atoms_of_a_state(kitchen: BurgerEnvironment) -> None:
    state = BurgerState((HAND, "board", "patty", "table"), cut=True)
    assert {f"{name}({', '.join(terms)})" for name, terms in kitchen.true_atoms(state)} == {
        "holding(robot, lettuce)",
        "on_station(patty, board)",
        "stacked_on(topbun, patty)",
        "on_table(bottombun)",
        "station_empty(stove)",
        "is_cut(lettuce)",
    }


def test_system_predicates_tell_all_states_apart(kitchen: BurgerEnvironment) -> None:
    groundings = set(all_groundings(SYSTEM_PREDICATES, kitchen.domain.objects))
    descriptions = set()
    for state in kitchen.reachable_states():
        atoms = frozenset(Atom(name, terms) for name, terms in kitchen.true_atoms(state))
        assert atoms <= groundings
        descriptions.add(atoms)
    assert len(SYSTEM_PREDICATES) == 8
    assert len(descriptions) == 2417


def test_descriptions_give_no_rule_away(kitchen: BurgerEnvironment) -> None:
    domain = kitchen.domain
    texts = [domain.agent, *(s.description for s in domain.skills)]
    texts += [p.role for s in domain.skills for p in s.parameters]
    telling = re.compile(r"\b(empty|free|clear|must|only|if|when|unless|needs?|nothing|stove)\b")
    assert not [text for text in texts if telling.search(text.lower())]
    assert all(texts)
    assert all(o.description for o in domain.objects)

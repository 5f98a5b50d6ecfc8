"""The burger kitchen as the expert's model sees it, without pictures."""

from __future__ import annotations

from functools import cache

import numpy as np

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.planning import PlanningProblem, goal_from_state, parse_goal
from skillwrapper.world import SkillInstance

START = BurgerState()
STANDARD_GOALS = (
    "(is_cut lettuce)",
    "(and (is_cooked patty) (not (on_station patty stove)) (hand_empty robot))",
    "(and (stacked_on topbun patty) (stacked_on patty bottombun) (is_cut lettuce))",
    "(and (not (nothing_on topbun)) (not (hand_empty robot)))",
)


@cache
def ground_model() -> GroundModel:
    model = expert_model()
    return GroundModel.of(model, model.domain.objects)


def space() -> AtomSpace:
    return ground_model().space


def labels(state: BurgerState) -> Labels:
    row = np.zeros(len(space().atoms), dtype=np.int8)
    for atom in expert_atoms(state):
        row[space().column[atom]] = 1
    return row


def problem(goal: str | BurgerState, start: BurgerState = START) -> PlanningProblem:
    wanted = (
        parse_goal(goal, space())
        if isinstance(goal, str)
        else goal_from_state(space(), labels(goal))
    )
    return PlanningProblem.of(ground_model(), labels(start), wanted)


def run(plan: tuple[SkillInstance, ...], start: BurgerState = START) -> BurgerState:
    """The state after a plan all of whose skills must succeed."""
    environment, state = BurgerEnvironment(), start
    for instance in plan:
        success, state = environment.successor(state, instance)
        assert success, f"{instance} failed"
    return state

"""A burger kitchen whose pictures are the states written down: nothing is drawn or read."""

from __future__ import annotations

from functools import cache

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.exact.labelled_states import SceneStates
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.world import Picture


class SketchedKitchen(BurgerEnvironment):
    """Draws a state by writing it down."""

    def draw(self, state: BurgerState, layout: int) -> Picture:
        return Picture(repr(state).encode())


@cache
def sketched_states() -> SceneStates:
    return SceneStates(SketchedKitchen())


def space() -> StateSpace:
    return sketched_states().space


def make_problem(start: BurgerState, goal: BurgerState) -> Problem:
    """A problem between two states, of whatever class it is."""
    kitchen, states = SketchedKitchen(), space().states
    length = int(space().distances_from(states.index(start))[states.index(goal)])
    data = (kitchen.state_to_data(start), kitchen.state_to_data(goal))
    if length < 0:
        return Problem("p", ProblemClass.IMPOSSIBLE, 3, *data, reason="searched in vain")
    kind = ProblemClass.EASY if length < 8 else ProblemClass.HARD
    return Problem("p", kind, 3, *data, length=length)

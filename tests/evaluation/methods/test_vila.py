"""ViLa acts until the model says that it is done, that it is impossible, or actions run out."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.methods.vila import VilaSolver
from skillwrapper.evaluation.problems.causes import Cause
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.planning.questions import ActionAnswer, ActionQuestion
from skillwrapper.world.skills import parse_skill_instance

PICK, PLACE, CUT = (
    parse_skill_instance(text)
    for text in (
        "Pick(robot, lettuce)",
        "Place(robot, lettuce, board)",
        "Cut(robot, lettuce)",
    )
)
DONE, IMPOSSIBLE, NOTHING = (
    ActionAnswer((), done=True),
    ActionAnswer((), impossible=True),
    ActionAnswer(()),
)
RIGHT = (ActionAnswer((PICK, PLACE)), ActionAnswer((PLACE,)), ActionAnswer((CUT,)), DONE)


class ScriptedActor:
    """Gives prepared answers; the last one again and again."""

    def __init__(self, answers: Sequence[ActionAnswer]) -> None:
        self.answers = list(answers)
        self.questions: list[ActionQuestion] = []

    def next_actions(self, question: ActionQuestion) -> ActionAnswer:
        self.questions.append(question)
        return self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]


def problem(*, impossible: bool = False) -> Problem:
    kitchen = BurgerEnvironment()
    cut = BurgerState(("board", "table", "table", "table"), cut=True)
    start, goal = (kitchen.state_to_data(state) for state in (BurgerState(), cut))
    if impossible:
        return Problem("p", ProblemClass.IMPOSSIBLE, 7, goal, start, reason="cut")
    return Problem("p", ProblemClass.EASY, 7, start, goal, length=3)


def solve(actor: ScriptedActor, asked: Problem, actions: int = 35) -> ProblemResult:
    world = ProblemWorld(BurgerEnvironment())
    return VilaSolver(world, actor, actions, lambda: len(actor.questions)).solve(asked)


def test_solved_by_acting_and_looking() -> None:
    actor = ScriptedActor(RIGHT)
    found = solve(actor, problem())
    assert (found.solved, found.length, found.optimal, found.executions) == (True, 3, 3, 3)
    assert (found.budget, found.cause, found.calls) == (None, None, 4)
    assert found.plan == tuple(map(str, (PICK, PLACE, CUT)))
    kitchen = BurgerEnvironment()
    assert actor.questions[0].observation == kitchen.reset(seed=7)
    assert actor.questions[0].history == ()
    assert actor.questions[-1].history == ((PICK, True), (PLACE, True), (CUT, True))
    assert actor.questions[-1].observation == actor.questions[-1].goal


def test_last_action_allowed_may_be_the_last_needed() -> None:
    assert solve(ScriptedActor(RIGHT), problem(), actions=3).solved
    assert solve(ScriptedActor(RIGHT), problem(), actions=2).cause is Cause.OUT_OF_STEPS


@pytest.mark.parametrize(
    ("answers", "cause"),
    [
        ((ActionAnswer((PICK,)), DONE), Cause.WRONGLY_DONE),
        ((IMPOSSIBLE,), Cause.WRONGLY_IMPOSSIBLE),
        ((NOTHING,), Cause.UNUSABLE_ANSWER),
        ((ActionAnswer((CUT,)),), Cause.OUT_OF_STEPS),
    ],
)
def test_not_solved(answers: Sequence[ActionAnswer], cause: Cause) -> None:
    found = solve(ScriptedActor(answers), problem())
    assert (found.solved, found.length, found.cause) == (False, None, cause)
    assert found.claimed_impossible is (cause is Cause.WRONGLY_IMPOSSIBLE)


def test_failed_skills_are_told() -> None:
    actor = ScriptedActor((ActionAnswer((CUT,)),))
    found = solve(actor, problem(), actions=5)
    assert found.executions == 5
    assert found.detail == "5 skills, 5 of them failed"
    assert actor.questions[-1].history == ((CUT, False),) * 5


def test_impossible_problem() -> None:
    found = solve(ScriptedActor((IMPOSSIBLE,)), problem(impossible=True))
    assert (found.solved, found.claimed_impossible, found.cause) == (True, True, None)
    found = solve(ScriptedActor((DONE,)), problem(impossible=True))
    assert (found.solved, found.cause) == (False, Cause.WRONGLY_DONE)

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PIL import Image
from planning_kitchen import STANDARD_GOALS, START, problem

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.planning import Planner, SkillPlan, attempt, save_gif
from skillwrapper.world import SkillInstance


def skills(*texts: str) -> SkillPlan:
    return tuple(SkillInstance(t.split()[0], ("robot", *t.split()[1:])) for t in texts)


CUTTING = skills("Pick lettuce", "Place lettuce board", "Cut lettuce")
TOO_SHORT = CUTTING[:2]
FAILING = skills("Pick lettuce", "Cut lettuce", "Place lettuce board")


@pytest.fixture
def kitchen() -> BurgerEnvironment:
    environment = BurgerEnvironment()
    environment.reset(seed=0)
    return environment


def is_cut(kitchen: BurgerEnvironment) -> bool:
    return bool(kitchen.get_state().cut)


def test_plans_are_tried_from_the_start_until_one_works(kitchen: BurgerEnvironment) -> None:
    starts = []

    def prepare() -> None:
        starts.append(kitchen.get_state())
        kitchen.set_state(START)

    report = attempt(
        kitchen, prepare, [FAILING, TOO_SHORT, CUTTING, TOO_SHORT], lambda: is_cut(kitchen)
    )
    assert (report.solved, report.budget, len(starts)) == (True, 3, 3)
    assert [a.failed_at for a in report.attempts] == [1, None, None]
    assert [a.goal_reached for a in report.attempts] == [False, False, True]
    assert [len(a.observations) for a in report.attempts] == [3, 3, 4]
    assert len({a.start.key for a in report.attempts}) == 1
    assert report.executions == 2 + 2 + 3
    assert report.attempts[0].to_json()["message"]
    assert json.loads(json.dumps(report.to_json()))["budget"] == 3


def test_unsolved_counts_with_the_whole_budget(kitchen: BurgerEnvironment) -> None:
    report = attempt(
        kitchen, lambda: kitchen.set_state(START), [TOO_SHORT] * 12, lambda: is_cut(kitchen)
    )
    assert (report.solved, report.budget, len(report.attempts)) == (False, 10, 10)
    nothing = attempt(kitchen, lambda: None, [], lambda: True)
    assert (nothing.solved, nothing.budget) == (False, 10)


def test_reached_goal_does_not_excuse_a_failed_skill(kitchen: BurgerEnvironment) -> None:
    report = attempt(kitchen, lambda: kitchen.set_state(START), [FAILING], lambda: True)
    assert not report.solved


def test_empty_plan(kitchen: BurgerEnvironment) -> None:
    report = attempt(kitchen, lambda: None, [()], lambda: True)
    assert (report.solved, report.budget, report.executions) == (True, 1, 0)
    assert len(report.attempts[0].observations) == 1


def test_plan_and_execute(kitchen: BurgerEnvironment) -> None:
    result = Planner().solve(problem(STANDARD_GOALS[2]))
    report = attempt(
        kitchen, lambda: kitchen.set_state(START), result.plans, lambda: is_cut(kitchen)
    )
    assert (report.solved, report.budget) == (True, 1)


@pytest.mark.parametrize("plan", [FAILING, TOO_SHORT, CUTTING, ()])
def test_gif(kitchen: BurgerEnvironment, tmp_path: Path, plan: SkillPlan) -> None:
    report = attempt(kitchen, lambda: kitchen.set_state(START), [plan], lambda: is_cut(kitchen))
    path = tmp_path / "new" / "attempt.gif"
    save_gif(path, report.attempts[0], goal="is_cut(lettuce)")
    with Image.open(path) as picture:
        assert picture.n_frames == len(report.attempts[0].observations)
        assert picture.width == 512
        assert picture.height > 512

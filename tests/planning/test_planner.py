"""Plans are the shortest ones, and right: by the true kitchen, by K*'s own front end, by others."""

from __future__ import annotations

import random
import re
import tempfile
import time
import warnings
from collections import deque
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kstar_planner import planners
from planning_kitchen import STANDARD_GOALS, START, ground_model, labels, problem, run, space
from pydantic import ValidationError

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.errors import MissingDependencyError, UnknownNameError
from skillwrapper.grounding import GroundModel
from skillwrapper.planning import (
    Goal,
    KStar,
    Planner,
    PlannerSettings,
    PlanningProblem,
    PlanningStatus,
    goal_from_state,
    parse_goal,
    write_pddl,
)
from skillwrapper.symbols import AbstractModel, ConditionalEffect, Literal, Operator, Variable
from skillwrapper.symbols.pddl import print_domain, print_problem
from skillwrapper.symbols.predicates import Atom
from skillwrapper.world import Object, SkillInstance

ENVIRONMENT = BurgerEnvironment()


def holds(goal: str, state: BurgerState) -> bool:
    return parse_goal(goal, space()).holds(space(), labels(state))


def costs_by_plan_topk(asked: PlanningProblem, folder: Path, **options: str) -> list[int]:
    files = write_pddl(asked, folder)
    found = planners.plan_topk(files.domain, files.problem, 10, timeout=30, **options)
    return [plan["cost"] for plan in found["plans"]]


def costs_by_us(asked: PlanningProblem) -> list[int]:
    return [len(plan) + 1 for plan in KStar.installed().search(asked, 10, 30.0).plans]


@pytest.mark.parametrize("goal", STANDARD_GOALS)
def test_ten_different_plans_that_work(goal: str) -> None:
    result = Planner().solve(problem(goal))
    assert result.status is PlanningStatus.SOLVED
    assert len(result.plans) == 10
    assert all(holds(goal, run(plan)) for plan in result.plans)


@pytest.mark.parametrize("goal", STANDARD_GOALS)
def test_costs_are_those_of_plan_topk(
    goal: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # it leaves files behind
    costs = costs_by_us(problem(goal))
    assert len(costs) == 10
    assert costs == costs_by_plan_topk(problem(goal), tmp_path)


def cooking(operator: Operator) -> Operator:
    """Cutting also cooks whatever is on the stove and not held; other operators stay."""
    if operator.skill != "Cut":
        return operator
    stove, each = Variable("?stove", ("cooker",)), Variable("?each", ("cookable",))
    on_stove = Literal(Atom("on_station", ("?each", "?stove")))
    held = Literal(Atom("holding", ("?robot", "?each")), positive=False)
    cooked = Literal(Atom("is_cooked", ("?each",)))
    return replace(
        operator,
        parameters=(*operator.parameters, stove),
        conditional_effects=frozenset({ConditionalEffect(each, (on_stove, held), cooked)}),
    )


def test_conditional_effects_as_by_plan_topk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A kitchen without Cook, where cutting the lettuce also cooks a patty on the stove."""
    monkeypatch.chdir(tmp_path)
    operators = [cooking(o) for o in expert_model().operators if o.skill != "Cook"]
    model = GroundModel.from_operators(operators, space())
    goal = parse_goal("(and (is_cut lettuce) (is_cooked patty))", space())
    asked = PlanningProblem.of(model, labels(START), goal)
    costs = costs_by_us(asked)
    assert costs[0] == 6
    assert costs == costs_by_plan_topk(asked, tmp_path, search_heuristic="hmax()")
    # With symmetries, as plan_topk has them, some of these plans would not work.
    assert all(map(asked.is_plan, KStar.installed().search(asked, 10, 30.0).plans))


def distance(start: BurgerState, goal: BurgerState) -> int | None:
    found, waiting = {start: 0}, deque([start])
    while waiting and goal not in found:
        state = waiting.popleft()
        for instance in ENVIRONMENT.domain.skill_instances:
            success, following = ENVIRONMENT.successor(state, instance)
            if success and following not in found:
                found[following] = found[state] + 1
                waiting.append(following)
    return found.get(goal)


def test_shortest_by_search_in_the_true_kitchen() -> None:
    states = ENVIRONMENT.reachable_states()
    chance = random.Random(3)
    pairs = [(START, chance.choice(states)) for _ in range(5)]
    pairs += [tuple(chance.choices(states, k=2)) for _ in range(5)]
    for start, goal in pairs:
        result = Planner(PlannerSettings(plans=2)).solve(problem(goal, start))
        best = distance(start, goal)
        assert (result.status is PlanningStatus.UNSOLVABLE) == (best is None)
        if best is not None:
            assert len(result.plans[0]) == best
            assert run(result.plans[0], start) == goal


def test_unified_planning_validates_the_plan_on_the_lifted_domain() -> None:
    from unified_planning.engines import SequentialPlanValidator  # noqa: PLC0415
    from unified_planning.io import PDDLReader  # noqa: PLC0415
    from unified_planning.plans import ActionInstance, SequentialPlan  # noqa: PLC0415

    asked, model = problem(STANDARD_GOALS[2]), expert_model()
    (numbers, *_) = KStar.installed().search(asked, 1, 30.0).plans
    (goal,) = asked.goal.alternatives
    printed = print_problem(model, model.domain.objects, expert_atoms(START), goal)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        lifted = PDDLReader().parse_problem_string(print_domain(model), printed)
        steps = []
        for action in (asked.actions[number] for number in numbers):
            names = [n if n != "robot" else "robot_2" for n in action.arguments]
            terms = [lifted.object(n) for n in names]
            steps.append(ActionInstance(lifted.action(action.operator.name.lower()), terms))
        verdict = SequentialPlanValidator().validate(lifted, SequentialPlan(steps))
        shortened = SequentialPlanValidator().validate(lifted, SequentialPlan(steps[1:]))
    assert verdict
    assert not shortened


CHOICES = (
    "(or (is_cut lettuce) (is_cooked patty))",
    "(exists (?x - pickupable) (stacked_on ?x patty))",
    "(imply (hand_empty robot) (and (is_cut lettuce) (not (on_station lettuce board))))",
    "(forall (?x - cuttable) (exists (?y - pickupable) (and (not (= ?x ?y)) (stacked_on ?x ?y))))",
)


@pytest.mark.parametrize("goal", CHOICES)
def test_goals_that_leave_a_choice(goal: str) -> None:
    """The shortest plan is that of the nearest alternative, and all plans reach one."""
    asked = problem(goal)
    assert len(asked.goal.alternatives) > 1
    result = Planner().solve(asked)
    assert result.status is PlanningStatus.SOLVED
    assert len(result.plans) == len(set(result.plans)) == 10
    assert all(holds(goal, run(plan)) for plan in result.plans)
    one_by_one = [
        Planner(PlannerSettings(plans=1)).solve(replace(asked, goal=Goal((alternative,))))
        for alternative in asked.goal.alternatives
    ]
    lengths = [len(found.plans[0]) for found in one_by_one if found.plans]
    assert len(result.plans[0]) == min(lengths)


def test_choices_cost_what_plan_topk_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert costs_by_us(problem(CHOICES[0])) == costs_by_plan_topk(problem(CHOICES[0]), tmp_path)


@pytest.mark.parametrize(
    "goal",
    ["(or (is_cut lettuce) (not (is_cut lettuce)))", "(or (hand_empty robot) (is_cut lettuce))"],
)
def test_goal_of_which_one_alternative_holds_already(goal: str) -> None:
    result = Planner().solve(problem(goal))
    assert (result.status, result.plans) == (PlanningStatus.SOLVED, ((),))


def test_goal_that_holds_already() -> None:
    result = Planner().solve(problem("(hand_empty robot)"))
    assert (result.status, result.plans) == (PlanningStatus.SOLVED, ((),))
    assert problem(START).is_solved


def test_unsolvable() -> None:
    impossible = "(and (stacked_on patty topbun) (stacked_on topbun patty))"
    result = Planner().solve(problem(impossible))
    assert (result.status, result.plans) == (PlanningStatus.UNSOLVABLE, ())


def test_unknown_at_the_start_counts_as_false_and_is_reported() -> None:
    row, atom = labels(START), Atom("hand_empty", ("robot",))
    row[space().column[atom]] = -1
    asked = PlanningProblem.of(ground_model(), row, parse_goal("(is_cut lettuce)", space()))
    result = Planner().solve(asked)
    assert result.guessed == (atom,)
    assert result.status is PlanningStatus.UNSOLVABLE


def with_twins(skill: str, needs: str = "") -> AbstractModel:
    """The expert's model with every operator of a skill twice, the second needing more."""
    model = expert_model()
    more = frozenset({Literal(Atom(needs, ("?robot",)), False)} if needs else ())
    twins = [
        replace(o.renamed(f"{o.name}_again"), preconditions=o.preconditions | more)
        for o in model.operators_of(skill)
    ]
    return replace(model, operators=(*model.operators, *twins))


@pytest.mark.parametrize("needs", ["", "hand_empty"])
def test_same_skills_count_once(needs: str) -> None:
    once, model = Planner().solve(problem(STANDARD_GOALS[2])), with_twins("Place", needs)
    goal = problem(STANDARD_GOALS[2]).goal
    result = Planner().plan(model, model.domain.objects, labels(START), goal)
    assert [len(p) for p in result.plans] == [len(p) for p in once.plans]
    assert len(result.plans) == 10


def many_buns(number: int) -> PlanningProblem:
    """Buns side by side, to be stacked in an order that leaves too much choice."""
    model = expert_model()
    buns = [Object(f"bun{i}", ("pickupable",)) for i in range(number)]
    kept = [o for o in model.domain.objects if "pickupable" not in o.types]
    ground = GroundModel.of(model, [*kept, *buns])
    true = {"hand_empty", "nothing_on", "station_free"}
    row = np.array([a.predicate in true for a in ground.space.atoms], dtype=np.int8)
    on_bun2 = [Literal(Atom("stacked_on", (f"bun{i}", "bun2"))) for i in (1, 3)]
    return PlanningProblem.of(ground, row, on_bun2)


def test_out_of_time_is_not_unsolvable(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    result = Planner(PlannerSettings(time_limit=0.5)).solve(many_buns(10))
    assert (result.status, result.plans) == (PlanningStatus.TIMEOUT, ())
    assert result.seconds < 1.5
    assert not list(tmp_path.iterdir())


def test_planner_that_hangs_is_killed(tmp_path: Path) -> None:
    started = time.monotonic()
    outcome = fake_planner(tmp_path, "sleep 60 & sleep 60").search(
        problem(STANDARD_GOALS[0]), 1, 0.2
    )
    assert time.monotonic() - started < 1.2
    assert outcome.status is PlanningStatus.TIMEOUT


def fake_planner(folder: Path, script: str, shebang: str = "#!/bin/sh") -> KStar:
    program = folder / "planner"
    program.write_text(f"{shebang}\n{script}\n", encoding="utf-8")
    program.chmod(0o755)
    return KStar(program)


@pytest.mark.parametrize(
    ("script", "expected"),
    [
        ("exit 12", PlanningStatus.UNSOLVABLE),
        ("sleep 0.2; exit 11", PlanningStatus.UNSOLVABLE),
        ("echo 'search::time limit reached'; exit 12", PlanningStatus.TIMEOUT),
        ("sleep 0.5; exit 12", PlanningStatus.TIMEOUT),
        ("echo '{\"plans\": [' > plans.json; sleep 60", PlanningStatus.TIMEOUT),
    ],
)
def test_what_an_end_of_the_planner_means(
    tmp_path: Path, script: str, expected: PlanningStatus
) -> None:
    seconds = 0.4 if "sleep" in script else 30.0
    planner = Planner(PlannerSettings(time_limit=seconds), fake_planner(tmp_path, script))
    result = planner.solve(problem(STANDARD_GOALS[0]))
    assert result.status is expected
    assert result.seconds < 30.0
    assert result.cause == ""


def plans(text: str) -> str:
    return f"cat > plans.json << 'EOF'\n{text}\nEOF"


@pytest.mark.parametrize(
    ("script", "cause"),
    [
        ("echo broken; exit 32", "met a critical error"),
        ("exit 22", "ran out of memory"),
        ("exit 77", "ended with the exit code 77"),
        ("kill -SEGV $$", "was ended by SIGSEGV"),
        ("kill -KILL $$", "was ended by SIGKILL, perhaps for want of memory"),
        ("exit 0", "as if it had found plans, and wrote none"),
        ("cat", "as if it had found plans, and wrote none"),
        ("mkdir plans.json", "can be read: plans.json is no file"),
        ("mkfifo plans.json", "can be read: plans.json is no file"),
        ("ln -s /dev/zero plans.json", "can be read: plans.json is no file"),
        ("head -c 100000 /dev/urandom > plans.json", "no plans that can be read"),
        (plans(""), "no plans that can be read"),
        (plans('{"plans": ['), "no plans that can be read"),
        (plans('{"plans": [') + "; exit 12", "no plans that can be read"),
        (plans("[" * 100_000), "no plans that can be read"),
        (plans("[]"), "no plans that can be read"),
        (plans("null"), "no plans that can be read"),
        (plans('{"plans": null}'), "valid array, at plans"),
        (plans('{"plans": [{"cost": 1}]}'), "Field required, at plans.0.actions"),
        (plans('{"plans": [{"cost": NaN, "actions": ["finish"]}]}'), "finite number"),
        (plans('{"plans": [{"cost": 1, "actions": [7]}]}'), "valid string, at plans.0.actions.0"),
        (plans('{"plans": [{"cost": 1, "actions": []}]}'), "to end with finish, got ''"),
        (plans('{"plans": [{"cost": 1, "actions": ["action-0"]}]}'), "to end with finish"),
        (plans('{"plans": [{"cost": 1, "actions": ["jump", "finish"]}]}'), "got 'jump'"),
        (plans('{"plans": [{"cost": 1, "actions": ["action--1", "finish"]}]}'), "got 'action--1'"),
        (plans('{"plans": [{"cost": 1, "actions": ["action-²", "finish"]}]}'), "got 'action-²'"),
        (plans('{"plans": [{"cost": 1, "actions": ["action-99999", "finish"]}]}'), "got 99999"),
        (plans('{"plans": [{"cost": 1, "actions": ["finish"]}]}'), "do not reach the goal"),
    ],
)
def test_a_broken_planner_is_an_error_with_its_cause(
    tmp_path: Path, script: str, cause: str
) -> None:
    """From a fault found by use: these raised ten kinds of exception."""
    result = Planner(engine=fake_planner(tmp_path, script)).solve(problem(STANDARD_GOALS[0]))
    assert (result.status, result.plans) == (PlanningStatus.ERROR, ())
    assert re.search(cause, result.cause), result.log
    assert result.cause.startswith("the planner ")


def test_planners_that_cannot_be_started(tmp_path: Path) -> None:
    no_program = fake_planner(tmp_path, "", shebang="#!/nowhere/python")
    (tmp_path / "garbage").write_bytes(b"\x7fELF nonsense")
    (tmp_path / "garbage").chmod(0o755)
    (tmp_path / "text").write_text("not executable", encoding="utf-8")
    names = ("missing", "garbage", "text", ".")
    for engine in [no_program, *(KStar(tmp_path / name) for name in names)]:
        result = Planner(engine=engine).solve(problem(STANDARD_GOALS[0]))
        assert result.status is PlanningStatus.ERROR
        assert "cannot be run" in result.cause


def test_no_room_for_temporary_files(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "none"))
    result = Planner().solve(problem(STANDARD_GOALS[0]))
    assert result.status is PlanningStatus.ERROR
    assert "cannot be run" in result.cause


def test_goal_about_what_is_not_in_the_scene() -> None:
    goal = [Literal(Atom("is_cut", ("tomato",)))]
    with pytest.raises(UnknownNameError, match=r"unknown ground atom 'is_cut\(tomato\)'"):
        PlanningProblem.of(ground_model(), labels(START), goal)


def test_missing_planner(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    result = Planner().solve(problem(STANDARD_GOALS[0]))
    assert result.status is PlanningStatus.ERROR
    assert result.cause == "the planner K* is not installed; pip install kstar-planner"
    with pytest.raises(MissingDependencyError, match="pip install kstar-planner"):
        KStar.installed().check_installed()


@pytest.mark.parametrize("settings", [{"plans": 0}, {"time_limit": 0}, {"time": 3}])
def test_settings_that_make_no_sense(settings: dict[str, float]) -> None:
    with pytest.raises(ValidationError):
        PlannerSettings(**settings)


def test_files_are_kept_if_asked_for(tmp_path: Path) -> None:
    model = expert_model()
    goal = goal_from_state(space(), labels(START))
    Planner().plan(model, model.domain.objects, labels(START), goal, keep_files=tmp_path)
    domain = (tmp_path / "domain.pddl").read_text(encoding="utf-8")
    assert "; Pick(robot, lettuce)" in domain
    assert "(not (is_cut--lettuce))" in domain
    assert "forall" not in domain


def test_same_problem_same_plans() -> None:
    first, second = (Planner().solve(problem(STANDARD_GOALS[2])) for _ in range(2))
    assert first.plans == second.plans
    assert isinstance(first.plans[0][0], SkillInstance)

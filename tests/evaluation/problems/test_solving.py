"""The expert solves everything; whoever lacks something is told what."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from pydantic import TypeAdapter
from sketched_kitchen import SketchedKitchen, make_problem, sketched_states

from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.evaluation.exact.state_readers import (
    AtomReader,
    Situation,
    StateReader,
    system_reader,
)
from skillwrapper.evaluation.problems.causes import Cause
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.evaluation.problems.solving import ModelSolver
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.perception.acquaintance import Acquaintance, FamiliarStates
from skillwrapper.planning import KStar, Planner
from skillwrapper.planning.hypotheses.doubtful_planner import DoubtfulPlanner
from skillwrapper.planning.kstar import SearchOutcome
from skillwrapper.planning.problem import PlanningProblem
from skillwrapper.planning.result import PlanningStatus
from skillwrapper.symbols import AbstractModel, Atom, Literal, Operator

START = BurgerState()
CUT = BurgerState(("board", "table", "table", "table"), cut=True)
STACKED = BurgerState(("patty", "stove", "table", "table"))
TRUTH = AtomReader(expert_atoms)


@dataclass(frozen=True)
class Misreader:
    """Takes one atom of one state for the opposite."""

    state: BurgerState
    atom: Atom
    label: int | None = None

    def read(self, atoms: AtomSpace, situations: Sequence[Situation]) -> Labels:
        labels = TRUTH.read(atoms, situations)
        for row, situation in enumerate(situations):
            if situation.state == self.state:
                column = atoms.column[self.atom]
                labels[row, column] = 1 - labels[row, column] if self.label is None else self.label
        return labels


def solve(
    problem: Problem, model: AbstractModel | None = None, reader: StateReader = TRUTH
) -> ProblemResult:
    return solver_of(model or expert_model(), reader).solve(problem)


def solver_of(
    model: AbstractModel,
    reader: StateReader = TRUTH,
    planner: Planner | None = None,
    kitchen: SketchedKitchen | None = None,
) -> ModelSolver:
    world = ProblemWorld(kitchen or SketchedKitchen())
    truth = {"default": LabelledStates(sketched_states(), TRUTH)}
    return ModelSolver(world, model, reader, planner or Planner(), truth)


def changed(skill: str, change: Callable[[Operator], Operator]) -> AbstractModel:
    model = expert_model()
    operators = tuple(change(o) if o.skill == skill else o for o in model.operators)
    return replace(model, operators=operators)


def without(skill: str) -> AbstractModel:
    model = expert_model()
    return replace(model, operators=tuple(o for o in model.operators if o.skill != skill))


def test_solved_with_the_first_plan() -> None:
    found = solve(make_problem(START, CUT))
    assert (found.solved, found.budget, found.cause, found.detail) == (True, 1, None, "")
    assert (found.length, found.optimal, found.executions) == (3, 3, 3)
    assert found.plan[-1] == "Cut(robot, lettuce)"
    assert 0 < found.planning_seconds < found.seconds
    assert TypeAdapter(ProblemResult).validate_json(json.dumps(found.to_json())) == found


def test_empty_plan_for_a_goal_that_holds() -> None:
    found = solve(make_problem(CUT, CUT))
    assert (found.solved, found.length, found.executions) == (True, 0, 0)


def test_impossible_is_recognised_by_proof() -> None:
    found = solve(make_problem(CUT, START))
    assert (found.solved, found.claimed_impossible, found.budget) == (True, True, None)
    assert (found.cause, found.length, found.optimal) == (None, None, None)


def test_plan_for_an_impossible_problem_is_a_failure() -> None:
    """Without knowing that something lies on an item, order can be changed, on paper."""
    model = changed("Pick", lambda o: replace(o, preconditions=_without(o, "nothing_on")))
    start = BurgerState(("stove", "lettuce", "board", "topbun"))
    found = solve(make_problem(start, BurgerState(("patty", "stove", "board", "topbun"))), model)
    assert (found.solved, found.claimed_impossible, found.budget) == (False, False, None)
    assert found.cause is not None
    assert found.executions > 0


def _without(operator: Operator, predicate: str) -> frozenset[Literal]:
    return frozenset(x for x in operator.preconditions if x.atom.predicate != predicate)


def test_missing_operator() -> None:
    found = solve(make_problem(START, CUT), without("Cut"))
    assert (found.solved, found.claimed_impossible, found.budget) == (False, True, 10)
    assert found.cause is Cause.OPERATOR_MISSING
    assert found.detail == "Cut(robot, lettuce) works, but no operator applies"


def test_wrong_effect_leaves_no_plan() -> None:
    model = changed("Cut", lambda o: replace(o, add_effects=frozenset()))
    found = solve(make_problem(START, CUT), model)
    assert found.cause is Cause.EFFECT_WRONG
    assert found.detail == "Cut(robot, lettuce): is_cut(lettuce) is true, not false"


def test_wrong_effect_in_a_plan() -> None:
    """Place is said to cut as well, so the plan stops too early."""
    cut = Atom("is_cut", ("?item",))

    def cutting(operator: Operator) -> Operator:
        parameters = tuple(
            replace(v, types=("cuttable",)) if v.name == "?item" else v for v in operator.parameters
        )
        return replace(operator, parameters=parameters, add_effects=operator.add_effects | {cut})

    found = solve(make_problem(START, CUT), changed("Place", cutting))
    assert (found.solved, found.cause) == (False, Cause.EFFECT_WRONG)
    assert "is_cut(lettuce) is false, not true" in found.detail


def test_failing_skill() -> None:
    """Whoever believes that the lettuce can be cut anywhere fails with all ten plans."""
    model = changed("Cut", lambda o: replace(o, preconditions=_without(o, "on_station")))
    found = solve(make_problem(START, BurgerState(("stove",) + ("table",) * 3, cut=True)), model)
    assert (found.solved, found.budget, found.cause) == (False, 10, Cause.SKILL_FAILED)
    assert found.detail == "Cut(robot, lettuce) is predicted to work, and fails"


def test_missing_predicate() -> None:
    """Who does not see that the lettuce is cut takes the goal for reached."""
    model = expert_model()
    blind = AbstractModel(
        model.domain,
        tuple(p for p in model.predicates if p.name != "is_cut"),
        tuple(o for o in model.operators if o.skill != "Cut"),
    )
    lying = BurgerState(("board", "table", "table", "table"))
    found = solve(make_problem(lying, CUT), blind)
    assert (found.solved, found.cause) == (False, Cause.PREDICATE_MISSING)
    assert found.detail == "start and goal have the same labels"
    found = solve(make_problem(START, CUT), blind)
    assert found.detail == "what was reached has the labels of the goal"


@pytest.mark.parametrize(
    ("state", "label", "cause"),
    [
        (START, None, Cause.START_MISREAD),
        (START, -1, Cause.START_MISREAD),
        (CUT, None, Cause.GOAL_MISREAD),
    ],
)
def test_misread_picture(state: BurgerState, label: int | None, cause: Cause) -> None:
    reader = Misreader(state, Atom("hand_empty", ("robot",)), label)
    found = solve(make_problem(START, CUT), reader=reader)
    assert (found.solved, found.cause) == (False, cause)
    wrong = "unknown" if label == -1 else "false"
    assert found.detail == f"hand_empty(robot) is true, not {wrong}"


def test_planner_out_of_time() -> None:
    class Slow(KStar):
        def search(self, problem: PlanningProblem, plans: int, seconds: float) -> SearchOutcome:
            return SearchOutcome(PlanningStatus.TIMEOUT, (), "")

    planner = Planner(engine=Slow(KStar.installed().program))
    solver = solver_of(expert_model(), planner=planner)
    found = solver.solve(make_problem(CUT, START))
    assert (found.solved, found.claimed_impossible) == (False, False)
    assert found.cause is Cause.PLANNER_OUT_OF_TIME


def test_a_broken_planner_is_not_one_out_of_time() -> None:
    solver = solver_of(expert_model(), planner=Planner(engine=KStar(Path("/nowhere/planner"))))
    found = solver.solve(make_problem(CUT, START))
    assert (found.solved, found.cause) == (False, Cause.PLANNER_BROKEN)
    assert "/nowhere/planner cannot be run" in found.detail


def test_every_attempt_starts_anew() -> None:
    """D13: the first plan fails half-way; the second one still starts where the problem does."""
    resets: list[int] = []

    class Watched(SketchedKitchen):
        def set_state(self, state: BurgerState, *, seed: int | None = None):  # type: ignore[no-untyped-def]
            resets.append(seed or 0)
            return super().set_state(state, seed=seed)

    model = changed("Cut", lambda o: replace(o, preconditions=_without(o, "on_station")))
    solver = solver_of(model, kitchen=Watched())
    found = solver.solve(make_problem(START, BurgerState(("stove",) + ("table",) * 3, cut=True)))
    assert found.solved is False
    assert resets == [3, 3] * 11  # reset and put there: for reading, and for each of ten plans


def test_readers_agree_on_what_both_know() -> None:
    kitchen = SketchedKitchen()
    shared = [p for p in expert_model().predicates if p.name in {"stacked_on", "is_cut"}]
    atoms = AtomSpace(tuple(shared), kitchen.domain.objects)
    seen = [Situation.of_state(kitchen, state) for state in (START, CUT, STACKED)]
    first, second = TRUTH.read(atoms, seen), system_reader(kitchen).read(atoms, seen)
    assert (first == second).all()
    assert first.sum() == 2


def test_a_misread_start_does_not_matter_to_a_plan_that_serves_both() -> None:
    """The patty is taken to be cooked already; as that may be wrong, it is cooked all the same."""
    cooked = BurgerState(("table", "board", "table", "table"), cooked=True)
    problem = make_problem(START, cooked)
    reader = Misreader(START, Atom("is_cooked", ("patty",)))
    assert not solve(problem, reader=reader).solved
    found = in_doubt(reader).solve(problem)
    assert (found.solved, found.budget, found.attempts) == (True, 1, 1)


def test_a_misread_goal_is_no_impossible_one() -> None:
    """Nothing is on the lettuce, and yet the patty lies on it, they say."""
    goal = BurgerState(("board", "lettuce", "table", "table"))
    reader = Misreader(goal, Atom("nothing_on", ("lettuce",)))
    problem = make_problem(START, goal)
    assert solve(problem, reader=reader).claimed_impossible
    assert in_doubt(reader).solve(problem).solved


def test_impossible_is_claimed_after_what_may_be_meant_was_tried() -> None:
    found = in_doubt(TRUTH).solve(make_problem(CUT, START))
    assert (found.solved, found.claimed_impossible, found.budget) == (True, True, None)
    assert found.attempts < 10


def in_doubt(reader: StateReader) -> ModelSolver:
    model, scene = expert_model(), SketchedKitchen().scene
    start = TRUTH.read(AtomSpace(model.predicates, scene.objects), [Situation.seen(None, START)])
    familiar = {scene: FamiliarStates.certain(start)}
    doubts = DoubtfulPlanner(model, Acquaintance(familiar=familiar))
    return replace(solver_of(model, reader), doubts=doubts)

"""Solving a problem with a model: read, plan, execute, and find out what went wrong."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from itertools import product

from skillwrapper.errors import UserError
from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.evaluation.exact.state_readers import Situation, StateReader
from skillwrapper.evaluation.problems.causes import Cause, Diagnosis, Diagnostician
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import Judge, ProblemResult
from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.planning.execution import PLANNING_BUDGET, ExecutionReport, attempt
from skillwrapper.planning.goals import Goal, goal_from_state, parse_goal
from skillwrapper.planning.planner import Planner
from skillwrapper.planning.problem import PlanningProblem
from skillwrapper.planning.result import PlanningResult, PlanningStatus
from skillwrapper.symbols import AbstractModel

_WITHOUT_AN_ANSWER = {
    PlanningStatus.TIMEOUT: Cause.PLANNER_OUT_OF_TIME,
    PlanningStatus.ERROR: Cause.PLANNER_BROKEN,
}


@dataclass(frozen=True)
class _Task:
    """A problem as the method reads it.

    Attributes:
        problem: as given.
        ground: the model over the objects of the scene.
        start: where it begins.
        start_labels: as read (atoms,).
        goal: what is wanted; None if it is given in literals only.
        goal_labels: as read (atoms,); None likewise.
        wanted: the goal to plan for.
    """

    problem: Problem
    ground: GroundModel
    start: Situation
    start_labels: Labels
    goal: Situation | None
    goal_labels: Labels | None
    wanted: Goal


@dataclass(frozen=True)
class ModelSolver:
    """Solves problems with an abstract model and a planner.

    Attributes:
        world: where problems are set up, plans executed and goals judged.
        model: the model.
        reader: reads start and goal.
        planner: finds plans.
        truth: all states with labels without error, by scene, to tell causes; may be empty.
        calls: how many questions were put to models so far.
    """

    world: ProblemWorld
    model: AbstractModel
    reader: StateReader
    planner: Planner
    truth: Mapping[str, LabelledStates] = field(default_factory=dict)
    calls: Callable[[], int] = lambda: 0

    def solve(self, problem: Problem) -> ProblemResult:
        """Solve one problem (docs/semantics.md, D12, D13)."""
        started, calls = time.monotonic(), self.calls()
        try:
            task = self._read(problem)
        except UserError as error:
            return _not_understood(problem, str(error), time.monotonic() - started)
        found = self.planner.solve(PlanningProblem.of(task.ground, task.start_labels, task.wanted))
        report, judge = self._execute(task, found)
        calls = self.calls() - calls
        claimed = found.status is PlanningStatus.UNSOLVABLE
        impossible = problem.kind is ProblemClass.IMPOSSIBLE
        solved = claimed if impossible else report.solved
        return ProblemResult.of(
            problem,
            solved=solved,
            diagnosis=None if solved else self._diagnose(task, found, report),
            claimed_impossible=claimed,
            budget=None if impossible else report.budget,
            length=len(report.attempts[-1].plan) if report.solved else None,
            executions=report.executions,
            successes=sum(o.success for a in report.attempts for o in a.outcomes),
            planning_seconds=found.seconds,
            seconds=time.monotonic() - started,
            calls=calls,
            plan=tuple(map(str, found.plans[0])) if found.plans else (),
            judge=judge,
        )

    def _read(self, problem: Problem) -> _Task:
        """Look at start and goal."""
        start, goal = self.world.start(problem), self.world.goal(problem)
        ground = GroundModel.of(self.model, self.world.environment.scene.objects)
        written = parse_goal(problem.goal_literals, ground.space) if problem.goal_literals else None
        shown = [start] if goal is None else [start, goal]
        labels = self.reader.read(ground.space, shown)
        goal_labels = None if goal is None else labels[1]
        seen = None if goal is None else goal_from_state(ground.space, labels[1])
        wanted = _together([part for part in (seen, written) if part is not None])
        return _Task(problem, ground, start, labels[0], goal, goal_labels, wanted)

    def _execute(self, task: _Task, found: PlanningResult) -> tuple[ExecutionReport, Judge]:
        judges = set()

        def is_reached() -> bool:
            truly = self.world.is_reached(task.problem)
            judges.add(Judge.MODEL if truly is None else Judge.ENVIRONMENT)
            if truly is not None:
                return truly
            space = task.ground.space
            return task.wanted.holds(space, self.reader.read(space, [self.world.now()])[0])

        environment = self.world.environment
        prepare = partial(self.world.start, task.problem)
        report = attempt(environment, prepare, found.plans, is_reached)
        return report, judges.pop() if judges else Judge.ENVIRONMENT

    def _diagnose(self, task: _Task, found: PlanningResult, report: ExecutionReport) -> Diagnosis:
        if found.status in _WITHOUT_AN_ANSWER:
            detail = found.cause or f"{found.status} after {found.seconds:.1f} s"
            return Diagnosis(_WITHOUT_AN_ANSWER[found.status], detail)
        truth = self.truth.get(self.world.environment.scene.name)
        if truth is None or task.goal is None or task.goal_labels is None:
            return _seen_from_outside(found, report)
        states = (task.start.state, task.goal.state)
        if any(state not in truth.states.space.index for state in states):
            return _seen_from_outside(found, report)
        expert = Diagnostician(truth, task.ground)
        misread = expert.misread(Cause.START_MISREAD, task.start_labels, states[0])
        misread = misread or expert.misread(Cause.GOAL_MISREAD, task.goal_labels, states[1])
        if misread is not None:
            return misread
        if not found.plans:
            return expert.no_plan(*states)
        return expert.blind(*states) or expert.bad_plan(*states, found.plans[0])


def _together(goals: list[Goal]) -> Goal:
    """That all goals hold."""
    combinations = product(*(goal.alternatives for goal in goals))
    return Goal(tuple(frozenset().union(*parts) for parts in combinations))


def _seen_from_outside(found: PlanningResult, report: ExecutionReport) -> Diagnosis:
    """What went wrong, where nobody knows the truth about states."""
    if not found.plans:
        return Diagnosis(Cause.NO_PLAN, f"the planner ended with: {found.status}")
    first = report.attempts[0]
    if first.failed_at is not None:
        return Diagnosis(Cause.SKILL_FAILED, f"{first.plan[first.failed_at]} failed")
    return Diagnosis(Cause.GOAL_NOT_REACHED, "all skills of the first plan succeeded")


def _not_understood(problem: Problem, reason: str, seconds: float) -> ProblemResult:
    """The model has no words for the goal."""
    return ProblemResult.of(
        problem,
        solved=False,
        diagnosis=Diagnosis(Cause.GOAL_NOT_EXPRESSIBLE, reason),
        claimed_impossible=False,
        budget=None if problem.kind is ProblemClass.IMPOSSIBLE else PLANNING_BUDGET,
        length=None,
        executions=0,
        planning_seconds=0.0,
        seconds=seconds,
        calls=0,
    )

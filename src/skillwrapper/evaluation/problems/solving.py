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
from skillwrapper.planning.hypotheses.attempts import attempt_in_doubt
from skillwrapper.planning.hypotheses.doubtful_planner import DoubtfulPlanner, WantedReading
from skillwrapper.planning.planner import Planner
from skillwrapper.planning.problem import PlanningProblem
from skillwrapper.planning.result import PlanningResult, PlanningStatus
from skillwrapper.symbols import AbstractModel
from skillwrapper.world.observation import Observation

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
        written: what is wanted in literals; None if nothing is.
        wanted: the goal to plan for.
    """

    problem: Problem
    ground: GroundModel
    start: Situation
    start_labels: Labels
    goal: Situation | None
    goal_labels: Labels | None
    written: Goal | None
    wanted: Goal


@dataclass(frozen=True)
class _Tried:
    """What was planned and run for a task.

    Attributes:
        found: what planning came to, with the first plan at least if there is one.
        report: the plans that were run.
        claimed: whether it is said that there is no solution.
        judge: who says whether the goal was reached.
    """

    found: PlanningResult
    report: ExecutionReport
    claimed: bool
    judge: Judge


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
        doubts: makes hypotheses of start and goal; None to take both as they are read.
    """

    world: ProblemWorld
    model: AbstractModel
    reader: StateReader
    planner: Planner
    truth: Mapping[str, LabelledStates] = field(default_factory=dict)
    calls: Callable[[], int] = lambda: 0
    doubts: DoubtfulPlanner | None = None

    def solve(self, problem: Problem) -> ProblemResult:
        """Solve one problem (docs/semantics.md, D12, D13)."""
        started, calls = time.monotonic(), self.calls()
        try:
            task = self._read(problem)
        except UserError as error:
            return _not_understood(problem, str(error), time.monotonic() - started)
        tried = self._try_hypotheses(task) or self._try_reading(task)
        found, report = tried.found, tried.report
        calls = self.calls() - calls
        impossible = problem.kind is ProblemClass.IMPOSSIBLE
        solved = tried.claimed if impossible else report.solved
        return ProblemResult.of(
            problem,
            solved=solved,
            diagnosis=None if solved else self._diagnose(task, found, report),
            claimed_impossible=tried.claimed,
            attempts=len(report.attempts),
            budget=None if impossible else report.budget,
            length=len(report.attempts[-1].plan) if report.solved else None,
            executions=report.executions,
            successes=sum(o.success for a in report.attempts for o in a.outcomes),
            planning_seconds=found.seconds,
            seconds=time.monotonic() - started,
            calls=calls,
            plan=tuple(map(str, found.plans[0])) if found.plans else (),
            judge=tried.judge,
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
        return _Task(problem, ground, start, labels[0], goal, goal_labels, written, wanted)

    def _try_reading(self, task: _Task) -> _Tried:
        """Take start and goal as they are read."""
        found = self.planner.solve(PlanningProblem.of(task.ground, task.start_labels, task.wanted))
        jury = _Jury(self.world, self.reader, task)
        prepare = partial(self.world.start, task.problem)
        report = attempt(self.world.environment, prepare, found.plans, jury.is_reached)
        return _Tried(found, report, found.status is PlanningStatus.UNSOLVABLE, jury.judge)

    def _try_hypotheses(self, task: _Task) -> _Tried | None:
        """Try what may be meant, the likeliest first; None where that cannot be told."""
        if self.doubts is None:
            return None
        started, environment = time.monotonic(), self.world.environment
        wanted = WantedReading(task.goal_labels, task.written)
        beliefs = self.doubts.beliefs(environment.scene, task.start_labels, wanted)
        if beliefs is None:
            return None
        seconds = time.monotonic() - started
        jury = _Jury(self.world, self.reader, task)
        trials = attempt_in_doubt(
            environment,
            partial(self.world.start, task.problem),
            beliefs,
            jury.is_reached,
            jury.read if self.doubts.settings.look_again else None,
        )
        plans = tuple(attempt.plan for attempt in trials.report.attempts[:1])
        status = PlanningStatus.SOLVED if plans else PlanningStatus.UNSOLVABLE
        found = PlanningResult(status, plans, seconds)
        return _Tried(found, trials.report, trials.claims_impossible, jury.judge)

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


@dataclass
class _Jury:
    """Judges whether the goal of a task is reached.

    Attributes:
        world: judges, where it can.
        reader: reads what is seen.
        task: the task.
        judge: who judged last.
    """

    world: ProblemWorld
    reader: StateReader
    task: _Task
    judge: Judge = Judge.ENVIRONMENT

    def is_reached(self) -> bool:
        """Whether the goal holds now."""
        truly = self.world.is_reached(self.task.problem)
        self.judge = Judge.MODEL if truly is None else Judge.ENVIRONMENT
        if truly is not None:
            return truly
        return self.task.wanted.holds(self.task.ground.space, self._read(self.world.now()))

    def read(self, seen: Observation) -> Labels:
        """What is true (atoms,) in a picture, as it is read."""
        return self._read(Situation.seen(seen))

    def _read(self, situation: Situation) -> Labels:
        labels: Labels = self.reader.read(self.task.ground.space, [situation])[0]
        return labels


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

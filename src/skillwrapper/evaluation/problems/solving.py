"""Solving a problem with a model: read, plan, execute, and find out what went wrong."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.evaluation.problems.causes import Cause, Diagnosis, Diagnostician
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.readers import StateReader
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.planning.execution import ExecutionReport, attempt
from skillwrapper.planning.goals import goal_from_state
from skillwrapper.planning.planner import Planner
from skillwrapper.planning.problem import PlanningProblem
from skillwrapper.planning.result import PlanningResult, PlanningStatus, SkillPlan
from skillwrapper.symbols import AbstractModel
from skillwrapper.world.capabilities import Enumerable


@dataclass(frozen=True)
class _Read:
    """Start and goal as states and as the method reads them."""

    start: Any
    goal: Any
    start_labels: Labels
    goal_labels: Labels


@dataclass(frozen=True)
class ModelSolver:
    """Solves problems with an abstract model and a planner.

    Attributes:
        environment: where plans are executed.
        space: its state space, which knows true solutions.
        model: the model.
        reader: reads start and goal.
        truth: reads the same without error, to tell causes.
        planner: finds plans.
        calls: how many questions were put to models so far.
    """

    environment: Enumerable
    space: StateSpace
    model: AbstractModel
    reader: StateReader
    truth: StateReader
    planner: Planner
    calls: Callable[[], int] = lambda: 0

    def solve(self, problem: Problem) -> ProblemResult:
        """Solve one problem (DESIGN.md D12, D13)."""
        started, calls = time.monotonic(), self.calls()
        ground = self._ground(problem)
        read = self._read(problem, ground)
        goal = goal_from_state(ground.space, read.goal_labels)
        found = self.planner.solve(PlanningProblem.of(ground, read.start_labels, goal))
        report = self._execute(problem, found, read)
        calls = self.calls() - calls
        claimed = found.status is PlanningStatus.UNSOLVABLE
        impossible = problem.kind is ProblemClass.IMPOSSIBLE
        solved = claimed if impossible else report.solved
        return ProblemResult.of(
            problem,
            solved=solved,
            diagnosis=None if solved else self._diagnose(ground, read, found),
            claimed_impossible=claimed,
            budget=None if impossible else report.budget,
            length=len(report.attempts[-1].plan) if report.solved else None,
            executions=report.executions,
            successes=sum(o.success for a in report.attempts for o in a.outcomes),
            planning_seconds=found.seconds,
            seconds=time.monotonic() - started,
            calls=calls,
            plan=tuple(map(str, found.plans[0])) if found.plans else (),
        )

    def _ground(self, problem: Problem) -> GroundModel:
        state = self.environment.state_from_data(problem.initial)
        self.environment.set_state(state, seed=problem.layout)
        objects = self.environment.scene.objects
        return GroundModel.of(self.model, objects)

    def _read(self, problem: Problem, ground: GroundModel) -> _Read:
        states = [self.environment.state_from_data(d) for d in (problem.initial, problem.goal)]
        labels = self.reader.read(ground.space, states)
        return _Read(*states, *labels)

    def _execute(self, problem: Problem, found: PlanningResult, read: _Read) -> ExecutionReport:
        return attempt(
            self.environment,
            lambda: self.environment.set_state(read.start, seed=problem.layout),
            found.plans,
            lambda: bool(self.environment.get_state() == read.goal),
        )

    def _diagnose(self, ground: GroundModel, read: _Read, found: PlanningResult) -> Diagnosis:
        if found.status in (PlanningStatus.TIMEOUT, PlanningStatus.ERROR):
            detail = f"{found.status} after {found.seconds:.1f} s"
            return Diagnosis(Cause.PLANNER_OUT_OF_TIME, detail)
        expert = Diagnostician(self.environment, ground, self.truth)
        misread = expert.misread(Cause.START_MISREAD, read.start_labels, read.start)
        misread = misread or expert.misread(Cause.GOAL_MISREAD, read.goal_labels, read.goal)
        if misread is not None:
            return misread
        if not found.plans:
            return expert.no_plan(read.start, self._solution(read))
        return expert.blind(read.start, read.goal) or expert.bad_plan(
            read.start, read.goal, found.plans[0]
        )

    def _solution(self, read: _Read) -> SkillPlan:
        states = self.space.states
        found = self.space.path_between(states.index(read.start), states.index(read.goal))
        return found or ()

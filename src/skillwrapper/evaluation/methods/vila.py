"""ViLa: a model names the next action from the picture, the goal's picture and what was done."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final, Protocol

from skillwrapper.evaluation.methods.method import CellContext, Prepared, Shares
from skillwrapper.evaluation.problems.causes import Cause, Diagnosis
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import Judge, ProblemResult
from skillwrapper.planning.questions import ActionAnswer, ActionQuestion
from skillwrapper.runs.archive import make_archive
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.world.skills import SkillInstance


class Actor(Protocol):
    """Who names actions; ``vlm.assistant.Assistant`` is one."""

    def next_actions(self, question: ActionQuestion) -> ActionAnswer:
        """The plan from the present picture on."""
        ...


@dataclass(frozen=True)
class _Run:
    """What was done for one problem, and what the model said in the end.

    Attributes:
        history: skills with whether they succeeded.
        answer: the last answer; None if skills ran out first, or nothing could be asked.
        shown: whether there was a picture of the goal to ask with.
    """

    history: tuple[tuple[SkillInstance, bool], ...]
    answer: ActionAnswer | None
    shown: bool = True


@dataclass(frozen=True)
class VilaSolver:
    """Asks after every skill; only the first action of a plan is executed.

    Attributes:
        world: where problems are set up, skills executed and goals judged.
        actor: names actions.
        actions: at most so many skills are executed.
        calls: how many questions were put to models so far.
    """

    world: ProblemWorld
    actor: Actor
    actions: int
    calls: Callable[[], int] = lambda: 0

    def solve(self, problem: Problem) -> ProblemResult:
        """Act until the model says that the goal is reached or impossible, or actions run out.

        A goal that is reached without the model noticing is not solved.
        """
        started, calls = time.monotonic(), self.calls()
        run = self._act(problem)
        truly = self.world.is_reached(problem)
        claimed = run.answer is not None and run.answer.impossible
        reached = run.answer is not None and run.answer.done and truly is not False
        impossible = problem.kind is ProblemClass.IMPOSSIBLE
        return ProblemResult.of(
            problem,
            solved=claimed if impossible else reached,
            diagnosis=_diagnose(run),
            claimed_impossible=claimed,
            budget=None,
            length=len(run.history) if reached else None,
            executions=len(run.history),
            successes=sum(succeeded for _, succeeded in run.history),
            planning_seconds=0.0,
            seconds=time.monotonic() - started,
            calls=self.calls() - calls,
            plan=tuple(str(instance) for instance, _ in run.history),
            judge=Judge.MODEL if truly is None else Judge.ENVIRONMENT,
        )

    def _act(self, problem: Problem) -> _Run:
        start, goal = self.world.start(problem), self.world.goal(problem)
        if goal is None:
            return _Run((), None, shown=False)
        picture = goal.look()
        if goal.state is not None:
            start = self.world.start(problem)  # to look at the goal, the world was put into it
        seen, environment = start.look(), self.world.environment
        domain, objects = environment.domain, environment.scene.objects
        history: tuple[tuple[SkillInstance, bool], ...] = ()
        # Once more than actions are allowed: the last one may have been the last that was needed.
        for _ in range(self.actions + 1):
            question = ActionQuestion(domain, objects, seen, picture, history)
            answer = self.actor.next_actions(question)
            if not answer.plan:
                return _Run(history, answer)
            if len(history) == self.actions:
                break
            outcome = environment.execute(answer.plan[0])
            history = (*history, (answer.plan[0], outcome.success))
            seen = outcome.observation
        return _Run(history, None)


def _diagnose(run: _Run) -> Diagnosis:
    failed = sum(not success for _, success in run.history)
    detail = f"{len(run.history)} skills, {failed} of them failed"
    if not run.shown:
        return Diagnosis(Cause.GOAL_NOT_SHOWN, "there is no picture of the goal to ask with")
    if run.answer is None:
        return Diagnosis(Cause.OUT_OF_STEPS, detail)
    if run.answer.impossible:
        return Diagnosis(Cause.WRONGLY_IMPOSSIBLE, detail)
    if run.answer.done:
        return Diagnosis(Cause.WRONGLY_DONE, detail)
    return Diagnosis(Cause.UNUSABLE_ANSWER, detail)


@dataclass(frozen=True)
class VilaMethod:
    """Acts without any model of the skills.

    Attributes:
        name: short, as in experiment files.
        title: as in tables.
        source: None: it learns nothing.
    """

    name: str = "vila"
    title: str = "ViLa"
    source: str | None = None

    @property
    def shares(self) -> Shares:
        """The model does everything."""
        return Shares("names every action", "executes them", decided_by_model=True)

    @contextmanager
    def prepare(self, context: CellContext) -> Iterator[Prepared]:
        """Open the model."""
        config = context.config()
        archive = make_archive(context.folder / "run", config, context.environment.domain)
        with open_session(config, archive.layout.calls, learning=False) as session:
            yield Prepared(
                VilaSolver(
                    context.world,
                    session.assistant,
                    context.settings.actions,
                    lambda: session.counter.answered,
                ),
                calls=archive,
            )


VILA: Final = VilaMethod()

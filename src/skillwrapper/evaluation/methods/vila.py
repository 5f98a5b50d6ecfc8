"""ViLa: a model names the next action from the picture, the goal's picture and what was done."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Final, Protocol

from skillwrapper.evaluation.methods.method import Bench, Prepared
from skillwrapper.evaluation.problems.causes import Cause, Diagnosis
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.planning.questions import ActionAnswer, ActionQuestion
from skillwrapper.runs.archive import make_archive
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.world.capabilities import Enumerable
from skillwrapper.world.skills import SkillInstance


class Actor(Protocol):
    """Who names actions; ``vlm.assistant.Assistant`` is one."""

    def next_actions(self, question: ActionQuestion) -> ActionAnswer:
        """The plan from the present picture on."""
        ...


@dataclass(frozen=True)
class _Run:
    """What was done for one problem, and what the model said in the end."""

    history: tuple[tuple[SkillInstance, bool], ...]
    answer: ActionAnswer | None


@dataclass(frozen=True)
class VilaSolver:
    """Asks after every skill; only the first action of a plan is executed.

    Attributes:
        environment: where skills are executed.
        actor: names actions.
        actions: at most so many skills are executed.
        calls: how many questions were put to models so far.
    """

    environment: Enumerable
    actor: Actor
    actions: int
    calls: Callable[[], int] = lambda: 0

    def solve(self, problem: Problem) -> ProblemResult:
        """Act until the model says that the goal is reached or impossible, or actions run out.

        A goal that is reached without the model noticing is not solved.
        """
        started, calls = time.monotonic(), self.calls()
        goal = self.environment.state_from_data(problem.goal)
        run = self._act(problem, goal)
        claimed = run.answer is not None and run.answer.impossible
        reached = run.answer is not None and run.answer.done
        reached = reached and bool(self.environment.get_state() == goal)
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
        )

    def _act(self, problem: Problem, goal: Any) -> _Run:
        start = self.environment.state_from_data(problem.initial)
        picture = self.environment.set_state(goal, seed=problem.layout)
        seen = self.environment.set_state(start)
        domain = self.environment.domain
        objects = self.environment.scene.objects
        history: tuple[tuple[SkillInstance, bool], ...] = ()
        # Once more than actions are allowed: the last one may have been the last that was needed.
        for _ in range(self.actions + 1):
            question = ActionQuestion(domain, objects, seen, picture, history)
            answer = self.actor.next_actions(question)
            if not answer.plan:
                return _Run(history, answer)
            if len(history) == self.actions:
                break
            outcome = self.environment.execute(answer.plan[0])
            history = (*history, (answer.plan[0], outcome.success))
            seen = outcome.observation
        return _Run(history, None)


def _diagnose(run: _Run) -> Diagnosis:
    failed = sum(not success for _, success in run.history)
    detail = f"{len(run.history)} skills, {failed} of them failed"
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

    @contextmanager
    def prepare(self, bench: Bench) -> Iterator[Prepared]:
        """Open the model."""
        config = bench.config()
        archive = make_archive(bench.folder / "run", config, bench.environment.domain)
        with open_session(config, archive.layout.calls, learning=False) as session:
            yield Prepared(
                VilaSolver(
                    bench.environment,
                    session.assistant,
                    bench.settings.actions,
                    lambda: session.counter.answered,
                ),
                calls=archive,
            )


VILA: Final = VilaMethod()

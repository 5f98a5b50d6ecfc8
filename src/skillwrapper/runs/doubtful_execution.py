"""Carrying out plans where readings may be wrong: what is believed is kept up from skill to skill.

Each picture is evidence, and so is whether a skill succeeds. The plan is followed as long as it
is about as likely to succeed as any other.
"""

from __future__ import annotations

from skillwrapper.grounding import Labels
from skillwrapper.planning.hypotheses.beliefs import Beliefs
from skillwrapper.planning.hypotheses.doubtful_planner import KnownScene, WantedReading
from skillwrapper.planning.hypotheses.state_filter import StateFilter
from skillwrapper.planning.result import SkillPlan
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.carrying_out import (
    Confirm,
    Ending,
    Execution,
    ExecutionSettings,
    Tell,
    agree,
    say_nothing,
)
from skillwrapper.runs.execution_records import ExecutionRecord
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation

_LEFT_BEHIND = 0.5
"""A plan is given up once it is less likely to succeed than another one by so much."""


class DoubtfulExecution(Execution):
    """Brings about a goal, weighing what is read by what skills do.

    Args:
        learned: the model.
        known: what is known of the scene.
        environment: the robot, ready to look.
        goal: what to bring about, as it was read.
        record: where it is written down.
        settings: how patient it is.
        confirm: asked before the first skill.
        tell: told what happens, for people.
    """

    def __init__(
        self,
        learned: LearnedModel,
        known: KnownScene,
        environment: Environment,
        goal: WantedReading,
        record: ExecutionRecord,
        settings: ExecutionSettings | None = None,
        confirm: Confirm = agree,
        tell: Tell = say_nothing,
    ) -> None:
        super().__init__(learned, environment, record, settings, confirm, tell)
        self._known, self._goals = known, known.goals(goal)

    def _carry_out(self) -> None:
        now = StateFilter(self._known, self._read(self._look()))
        while (plan := self._plan(now)) is not None:
            self._follow(plan, now)

    def _plan(self, now: StateFilter) -> SkillPlan | None:
        """The plan to follow; None if it ends here: doing nothing is best, or nothing helps."""
        beliefs = self._beliefs(now)
        plan = beliefs.next_plan()
        if plan is None:
            chance = f"the model knows no way, with a probability of {beliefs.unsolvable:.0%}"
            self._end(Ending.NO_PLAN, chance)
            return None
        if not plan:
            reached = now.reached(self._goals)
            self._end(Ending.REACHED, f"with a probability of {reached:.0%}")
            return None
        if self.report.plans > self._settings.replans:
            self._end(Ending.NOT_REACHED, f"{self.report.plans} plans were tried")
            return None
        space = self._known.ground.space
        state = AbstractState(self._environment.scene, space, now.likeliest)
        return plan if self._begin(plan, state) else None

    def _follow(self, plan: SkillPlan, now: StateFilter) -> None:
        """Run skills as long as no other plan has become much likelier to succeed."""
        seen = self._look()
        for number, instance in enumerate(plan, start=1):
            outcome = self._execute(seen, instance)
            seen = outcome.observation
            now.ran(instance, succeeded=outcome.success)
            now.look(self._read(seen))
            if not outcome.success:
                self._surprise("failed", instance)
                return
            beliefs, rest = self._beliefs(now), plan[number:]
            if rest and beliefs.chance(rest) < _LEFT_BEHIND * beliefs.best_chance:
                self._surprise("effect", instance)
                return

    def _beliefs(self, now: StateFilter) -> Beliefs:
        return self._known.beliefs(now.nats, self._goals)

    def _read(self, seen: Observation) -> Labels:
        return self._learned.read(seen, scene=self._environment.scene).labels

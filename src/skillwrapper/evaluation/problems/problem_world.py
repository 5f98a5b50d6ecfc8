"""Setting problems up in an environment, and telling whether their goals are reached."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from skillwrapper.errors import UserError
from skillwrapper.evaluation.exact.state_readers import Situation, system_reader
from skillwrapper.evaluation.problems.problems import Problem
from skillwrapper.grounding import AtomSpace
from skillwrapper.planning.goals import parse_goal
from skillwrapper.symbols import Predicate
from skillwrapper.world.capabilities import Judged, Settable, Truthful, require, supports
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation


@dataclass(frozen=True)
class ProblemWorld:
    """An environment in which problems are set up and judged.

    Attributes:
        environment: any that can be reset and executes skills.
        facts: predicates of which it tells what is true; none if it tells nothing.
    """

    environment: Environment
    facts: tuple[Predicate, ...] = ()

    def start(self, problem: Problem) -> Situation:
        """Put the environment into the start of a problem."""
        seen = self.environment.reset(seed=problem.layout, scene=problem.scene)
        if problem.initial is not None:
            settable = self._settable()
            state = settable.state_from_data(dict(problem.initial))
            return Situation.seen(settable.set_state(state, seed=problem.layout), state)
        return Situation.seen(seen, self._state())

    def goal(self, problem: Problem) -> Situation | None:
        """What the goal looks like; looking may change the world. None if it is not shown."""
        if problem.goal is not None:
            settable = self._settable()
            state = settable.state_from_data(dict(problem.goal))
            if problem.goal_picture is None:
                return Situation.of_state(settable, state)
            return Situation.seen(Observation((problem.goal_picture,)), state)
        if problem.goal_picture is not None:
            return Situation.seen(Observation((problem.goal_picture,)))
        return None

    def now(self) -> Situation:
        """How things are now."""
        return Situation(self.environment.observe, self._state())

    def is_reached(self, problem: Problem) -> bool | None:
        """Whether the goal of a problem is truly reached now.

        Returns:
            None if the environment cannot tell (docs/semantics.md, D25).
        """
        if problem.goal_test:
            judge = require(self.environment, Judged, "'goal_test'")
            return judge.is_reached(problem.goal_test)
        if problem.goal is not None:
            settable = self._settable()
            wanted = settable.state_from_data(dict(problem.goal))
            return bool(settable.get_state() == wanted)
        return self._hold(problem.goal_literals) if problem.goal_literals else None

    def _hold(self, literals: str) -> bool | None:
        """Whether literals are true facts; None if they are in words that are no facts."""
        if not self.facts or not supports(self.environment, Truthful):
            return None
        space = AtomSpace(self.facts, self.environment.scene.objects)
        try:
            goal = parse_goal(literals, space)
        except UserError:
            return None
        reader = system_reader(require(self.environment, Truthful, "judging literals"))
        return goal.holds(space, reader.read(space, [self.now()])[0])

    def _state(self) -> Any:
        return self._settable().get_state() if supports(self.environment, Settable) else None

    def _settable(self) -> Settable:
        return require(self.environment, Settable, "a problem with a state")

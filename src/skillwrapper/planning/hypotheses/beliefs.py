"""What is believed of start and goal: hypotheses with probabilities, and the plans that follow."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from skillwrapper.grounding import Labels
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.reading_model import ReadingModel
from skillwrapper.planning.hypotheses.possible_states import Course, PossibleStates
from skillwrapper.planning.hypotheses.settings import HypothesesSettings
from skillwrapper.planning.result import SkillPlan

_NEGLIGIBLE = math.log(1e-6)
"""Hypotheses that are less likely are left out, even if all likelier ones should be refuted."""


@dataclass(frozen=True)
class Hypothesis:
    """Where things may stand, and what may be wanted.

    Attributes:
        start: number of the state to start from.
        goals: numbers of the states any of which is wanted.
    """

    start: int
    goals: frozenset[int]


@dataclass(frozen=True, eq=False)
class GoalCandidates:
    """What may be wanted: of several sets of states one is meant.

    Attributes:
        goals: the sets, as numbers of states.
        nats: how likely each is meant (sets,), as far as is known.
    """

    goals: tuple[frozenset[int], ...]
    nats: Floats


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was seen of a plan that did not lead to the goal.

    Attributes:
        plan: the plan.
        succeeded: how many of its skills succeeded, the next one failed if there is one.
        seen: readings (n, atoms) of the pictures after the first ``n`` skills, where they were
            read; at most as many as succeeded.
    """

    plan: SkillPlan
    succeeded: int
    seen: Sequence[Labels] = ()


class Beliefs:
    """Hypotheses of start and goal, each with a probability.

    Args:
        possible: the states that can come about.
        readings: what readings are worth.
        start: how likely each state (states,) is the start, in nats.
        goals: what may be wanted.
        settings: how many hypotheses are kept, and which plans count.
    """

    def __init__(
        self,
        possible: PossibleStates,
        readings: ReadingModel,
        start: Floats,
        goals: GoalCandidates,
        settings: HypothesesSettings,
    ) -> None:
        self._possible, self._readings, self._settings = possible, readings, settings
        kept = sorted(_pairs(start, goals, settings.states), key=lambda pair: -pair[0])
        most = kept[0][0] if kept else 0.0
        kept = [pair for pair in kept if pair[0] - most > _NEGLIGIBLE]
        self.hypotheses = tuple(hypothesis for _, hypothesis in kept)
        self._nats: Floats = np.array([nats for nats, _ in kept])
        self._plans = tuple(possible.plan(h.start, h.goals) for h in self.hypotheses)
        self._tried: set[SkillPlan] = set()
        self._latest: SkillPlan = ()

    @property
    def probabilities(self) -> Floats:
        """Of every hypothesis (hypotheses,)."""
        weights = np.exp(self._nats - self._nats.max(initial=-math.inf))
        shares: Floats = weights / weights.sum() if len(weights) else weights
        return shares

    @property
    def unsolvable(self) -> float:
        """The probability of the hypotheses that the model knows no plan for."""
        without = np.array([plan is None for plan in self._plans], dtype=bool)
        return float(self.probabilities[without].sum()) if len(without) else 0.0

    @property
    def is_impossible(self) -> bool:
        """Whether hypotheses without a plan are likely enough to say that there is no solution."""
        return self.unsolvable > self._settings.claim

    def next_plan(self) -> SkillPlan | None:
        """The untried plan that most likely succeeds; None if none is likely enough."""
        candidates = self._candidates()
        chances = [self.chance(plan) for plan in candidates]
        best = int(np.argmax(chances)) if chances else -1
        if best < 0 or chances[best] <= self._settings.least:
            return None
        self._latest = candidates[best]
        return self._latest

    def is_reached(self, read: Labels) -> bool:
        """Whether the goal is reached by the latest plan, all of whose skills succeeded.

        That is, no other plan is likelier to succeed than it is that this one did.

        Args:
            read: what is read (atoms,) of the picture after it.
        """
        likely = self._readings.log_likelihood(self._possible.labels, read)
        ends = [
            (course.states or (hypothesis.start,))[-1]
            for hypothesis, course in self._courses(self._latest)
        ]
        fails = np.array([c.fails for _, c in self._courses(self._latest)], dtype=bool)
        nats = self._nats + likely[ends] + np.where(fails, math.log(self._settings.surprise), 0.0)
        weights = np.exp(nats - nats.max(initial=-math.inf))
        reached = [end in h.goals for end, h in zip(ends, self.hypotheses, strict=True)]
        chance = float(weights[np.array(reached) & ~fails].sum() / weights.sum())
        others = (self.chance(plan) for plan in self._candidates() if plan != self._latest)
        return chance > max(others, default=0.0)

    @property
    def best_chance(self) -> float:
        """The probability that the likeliest untried plan succeeds; 0 if there is none."""
        return max(map(self.chance, self._candidates()), default=0.0)

    def chance(self, plan: SkillPlan) -> float:
        """The probability that a plan succeeds, over all hypotheses."""
        succeeds = [
            not course.fails and (course.states or (hypothesis.start,))[-1] in hypothesis.goals
            for hypothesis, course in self._courses(plan)
        ]
        return float(self.probabilities[np.array(succeeds, dtype=bool)].sum())

    def learn(self, evidence: Evidence) -> None:
        """Take into account how a plan went wrong."""
        self._tried.add(evidence.plan)
        surprise = math.log(self._settings.surprise)
        likely = [self._readings.log_likelihood(self._possible.labels, s) for s in evidence.seen]
        # Where a course ended early, any state may have been seen later.
        usual = [float(np.logaddexp.reduce(nats)) - math.log(len(nats)) for nats in likely]
        for number, (hypothesis, course) in enumerate(self._courses(evidence.plan)):
            if not _is_expected(hypothesis, course, evidence):
                self._nats[number] += surprise
            expected = course.states[: len(likely)]
            self._nats[number] += sum(usual[len(expected) :])
            self._nats[number] += sum(float(likely[n][state]) for n, state in enumerate(expected))

    def _candidates(self) -> list[SkillPlan]:
        """The untried plans of hypotheses, the likeliest hypotheses first."""
        order = likeliest(self._nats, len(self._nats))
        plans = dict.fromkeys(self._plans[number] for number in order)
        untried = [plan for plan in plans if plan is not None and plan not in self._tried]
        return untried[: self._settings.states]

    def _courses(self, plan: SkillPlan) -> Iterator[tuple[Hypothesis, Course]]:
        courses: dict[int, Course] = {}
        for hypothesis in self.hypotheses:
            if hypothesis.start not in courses:
                courses[hypothesis.start] = self._possible.course(hypothesis.start, plan)
            yield hypothesis, courses[hypothesis.start]


def likeliest(nats: Floats, most: int) -> list[int]:
    """The places of the largest of some log-probabilities, the largest first."""
    places: list[int] = np.argsort(-nats, kind="stable")[:most].tolist()
    return places


def _pairs(start: Floats, goals: GoalCandidates, most: int) -> Iterator[tuple[float, Hypothesis]]:
    """The likeliest starts with all goals, and how likely each pair is, in nats."""
    for state in likeliest(start, most):
        for wanted, nats in zip(goals.goals, goals.nats.tolist(), strict=True):
            yield float(start[state]) + nats, Hypothesis(state, wanted)


def _is_expected(hypothesis: Hypothesis, course: Course, evidence: Evidence) -> bool:
    """Whether a plan was to go as it went, which was not to the goal."""
    if len(course.states) != evidence.succeeded:
        return False
    return course.fails or (course.states or (hypothesis.start,))[-1] not in hypothesis.goals

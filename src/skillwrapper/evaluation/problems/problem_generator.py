"""Making test problems by exact search over the true state space."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from skillwrapper.domains.package import DomainPackage, Impossibility
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.evaluation.problems.problems import (
    LONGEST_EASY,
    LONGEST_HARD,
    Problem,
    ProblemClass,
    ProblemSet,
)
from skillwrapper.world.capabilities import Enumerable

_TRIES = 200
_LENGTHS = {
    ProblemClass.EASY: range(1, LONGEST_EASY + 1),
    ProblemClass.HARD: range(LONGEST_EASY + 1, LONGEST_HARD + 1),
}
_PROVEN = Impossibility(
    ("proven",),
    lambda start, goal: ("proven", "no sequence of skills leads there (all were tried)"),
)
"""What can be said where the domain's package gives no reasons."""
_FIRST_LAYOUT, _LAYOUTS = 500_000, 400_000
"""Layouts of problems are none of those that a run with a small seed resets to."""


@dataclass
class ProblemGenerator:
    """Draws problems in the present scene, with a known optimal length or proven to be impossible.

    Lengths and kinds of impossibility take turns, and every second start is the standard one;
    among the goals that fit, one of the structures used least is taken.

    Args:
        environment: the domain.
        package: tells structures and reasons.
        seed: decides every choice.
    """

    environment: Enumerable
    package: DomainPackage
    seed: int
    _used: Counter[str] = field(default_factory=Counter, init=False)
    _taken: set[tuple[int, int]] = field(default_factory=set, init=False)

    def __post_init__(self) -> None:
        self._chance = random.Random(f"problems {self.seed}")
        self._space = StateSpace.of(self.environment)
        has_reasons = self.package.has("impossibility")
        self._impossibility = self.package.impossibility if has_reasons else _PROVEN

    def generate(self, easy: int, hard: int, impossible: int) -> ProblemSet:
        """A set with so many problems of each class.

        Raises:
            ConfigurationError: if the domain has not so many.
        """
        problems = (
            *self.solvable(ProblemClass.EASY, easy, _LENGTHS[ProblemClass.EASY]),
            *self.solvable(ProblemClass.HARD, hard, _LENGTHS[ProblemClass.HARD]),
            *self.impossible(impossible),
        )
        return ProblemSet(self.environment.domain.name, self.seed, problems)

    def solvable(self, kind: ProblemClass, count: int, lengths: range) -> Iterator[Problem]:
        """Problems of a class with optimal solutions of these lengths, spread over them.

        Raises:
            ConfigurationError: if the domain has not so many.
        """
        for number in range(count):
            wanted = lengths[number * len(lengths) // count]
            length, start, goal = self._draw_length(lengths.start, wanted, number % 2 == 0)
            yield self._problem(kind, number, start, goal, length=length)

    def _draw_length(self, shortest: int, wanted: int, standard: bool) -> tuple[int, int, int]:
        """Length, start and goal: of the wanted length, or shorter where that is not to be had."""
        for length in range(wanted, shortest, -1):
            with suppress(ConfigurationError):
                return (length, *self._draw_at(length, standard))
        return (shortest, *self._draw_at(shortest, standard))

    def _draw_at(self, length: int, standard: bool) -> tuple[int, int]:
        what = f"optimal solutions of {length} skills"
        return self._draw(partial(self._at_distance, length), what, standard=standard)

    def impossible(self, count: int) -> Iterator[Problem]:
        """Problems that are proven to have no solution.

        Raises:
            ConfigurationError: if the domain has not so many.
        """
        known = self._impossibility
        for number in range(count):
            kind = known.kinds[number % len(known.kinds)]
            start, goal = self._draw(
                partial(self._unreachable, kind),
                f"impossible problems of the kind {kind}",
                standard=False,
            )
            states = self._space.states
            found = known.explain(states[start], states[goal])
            reason = found[1] if found else ""
            yield self._problem(ProblemClass.IMPOSSIBLE, number, start, goal, reason=reason)

    def _draw(
        self, goals_from: Callable[[int], Iterable[int]], what: str, *, standard: bool
    ) -> tuple[int, int]:
        """A start and one of its goals that are not taken yet."""
        for attempt in range(_TRIES):
            first = standard and attempt == 0
            start = 0 if first else self._chance.randrange(len(self._space.states))
            goals = [g for g in goals_from(start) if (start, g) not in self._taken]
            if goals:
                goal = self._least_used(goals)
                self._taken.add((start, goal))
                return start, goal
        raise ConfigurationError(
            f"{self.environment.domain.name}: found no more {what}; ask for fewer problems"
        )

    def _at_distance(self, length: int, start: int) -> list[int]:
        return np.flatnonzero(self._space.distances_from(start) == length).tolist()

    def _unreachable(self, kind: str, start: int) -> list[int]:
        states = self._space.states
        explain = self._impossibility.explain
        reached = self._space.distances_from(start)
        return [
            goal
            for goal in np.flatnonzero(reached < 0).tolist()
            if (explain(states[start], states[goal]) or ("",))[0] == kind
        ]

    def _least_used(self, goals: list[int]) -> int:
        structure_of = self.package.structure
        structure = {goal: structure_of(self._space.states[goal]) for goal in goals}
        least = min(self._used[s] for s in structure.values())
        # A structure first, then a goal: else structures with many goals would come more often.
        open_structures = sorted({s for s in structure.values() if self._used[s] == least})
        chosen = self._chance.choice(open_structures)
        self._used[chosen] += 1
        return self._chance.choice([goal for goal in goals if structure[goal] == chosen])

    def _problem(
        self,
        kind: ProblemClass,
        number: int,
        start: int,
        goal: int,
        length: int | None = None,
        reason: str = "",
    ) -> Problem:
        states, domain = self._space.states, self.environment.domain
        return Problem(
            name=f"{kind}-{number + 1:02d}",
            kind=kind,
            layout=_FIRST_LAYOUT + self._chance.randrange(_LAYOUTS),
            initial=self.environment.state_to_data(states[start]),
            goal=self.environment.state_to_data(states[goal]),
            length=length,
            reason=reason,
            scene=self.environment.scene.name if len(domain.scenes) > 1 else None,
        )

"""Test problems: from a start to a goal, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from skillwrapper.world.observation import Picture

LONGEST_EASY = 7
LONGEST_HARD = 15
"""Optimal lengths up to which problems count as easy and hard (paper, Section 4.1)."""


class ProblemClass(StrEnum):
    """How difficult a problem is."""

    EASY = "easy"
    """An optimal solution has 1 to 7 skills."""
    HARD = "hard"
    """An optimal solution has 8 to 15 skills."""
    IMPOSSIBLE = "impossible"
    """No sequence of skills leads to the goal."""


@dataclass(frozen=True)
class Problem:
    """One problem; pictures of states are drawn when they are needed.

    Attributes:
        name: unique in its set.
        kind: how difficult it is.
        layout: the seed with which the environment is reset, and of the layout of pictures.
        initial: the state to start from, as plain data of the domain; None for what the reset
            with the seed gives.
        goal: the state to reach, as plain data of the domain; None if it is given otherwise.
        length: number of skills of an optimal solution; None if there is none, or nobody knows.
        reason: why it is impossible; empty if it is not.
        scene: name of one of the domain's scenes; None for the environment's choice.
        goal_picture: what the goal looks like; None for the picture of the goal state, if any.
        goal_literals: what must hold, in words of the model's predicates; empty for nothing.
        goal_test: name of the environment's own test of the goal; empty if there is none.
    """

    name: str
    kind: ProblemClass
    layout: int
    initial: Mapping[str, Any] | None
    goal: Mapping[str, Any] | None
    length: int | None = None
    reason: str = ""
    scene: str | None = None
    goal_picture: Picture | None = None
    goal_literals: str = ""
    goal_test: str = ""


@dataclass(frozen=True)
class ProblemSet:
    """Problems of one domain.

    Attributes:
        domain: name of the domain.
        seed: the seed they were made with.
        problems: the problems.
    """

    domain: str
    seed: int
    problems: tuple[Problem, ...]

    def of(self, kind: ProblemClass) -> tuple[Problem, ...]:
        """The problems of a class."""
        return tuple(p for p in self.problems if p.kind is kind)

    def first(self, easy: int, hard: int, impossible: int) -> ProblemSet:
        """At most so many problems of each class, the first ones of the set."""
        wanted = zip(ProblemClass, (easy, hard, impossible), strict=True)
        chosen = tuple(p for kind, count in wanted for p in self.of(kind)[:count])
        return ProblemSet(self.domain, self.seed, chosen)

"""Explorers: given the situation, the next skill or the end of the episode."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.untested import find_untested
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True, eq=False)
class Situation:
    """Where the next skill will be run; what costs model calls is done when it is looked at.

    Attributes:
        scene: the objects that are present.
        observation: what is seen now.
        done: the transitions of this episode so far.
        left: how many skills may still be run in this episode, at least 1.
        learn: learns from everything that was executed so far.
        read: the labels (atoms,) of what is seen now.
    """

    scene: Scene
    observation: Observation
    done: tuple[Transition, ...]
    left: int
    learn: Callable[[], Fit]
    read: Callable[[AtomSpace], Labels]

    @cached_property
    def fit(self) -> Fit:
        """What was learned so far."""
        return self.learn()

    @cached_property
    def space(self) -> AtomSpace:
        """The ground atoms of the vocabulary over the objects that are present."""
        return AtomSpace(self.fit.predicates, self.scene.objects)

    @cached_property
    def untested(self) -> Mapping[str, frozenset[Condition]]:
        """For every operator, by name, the conditions of which nothing shows that they matter."""
        return find_untested(self.fit)

    @cached_property
    def state(self) -> Labels:
        """The abstract state (atoms,)."""
        return self.read(self.space)


@dataclass(frozen=True)
class Candidate:
    """A sequence with its two scores."""

    sequence: tuple[SkillInstance, ...]
    balance: float
    coverage: float


@dataclass(frozen=True)
class SequenceChoice:
    """The chosen sequence and how it was chosen.

    Attributes:
        sequence: what to execute, as long as the budget.
        candidates: all candidates with their scores.
        pareto: indices of the candidates in the Pareto set.
        notes: what was repaired or dropped.
    """

    sequence: tuple[SkillInstance, ...]
    candidates: tuple[Candidate, ...]
    pareto: tuple[int, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class NextSkill:
    """What to run next.

    Attributes:
        instance: the skill instance; None to end the episode.
        reason: why, in words.
        sequence: how the whole sequence was chosen, where it was chosen just now.
        resumes: of an end, whether what is left of the budget is better used after a reset.
    """

    instance: SkillInstance | None
    reason: str = ""
    sequence: SequenceChoice | None = None
    resumes: bool = False


class Explorer(Protocol):
    """Chooses what to try; same situations and episodes, in the same order, give same choices."""

    def next_skill(self, situation: Situation) -> NextSkill:
        """The next skill to run, or the end of the episode."""
        ...

    def record(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        ...

"""What explorers are given and what they answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.exploration.explorer import Choice
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.learning.fitting import Fit
from skillwrapper.world.episode import Transition
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
    def state(self) -> Labels:
        """The abstract state (atoms,)."""
        return self.read(self.space)


@dataclass(frozen=True)
class NextSkill:
    """What to run next.

    Attributes:
        instance: the skill instance; None to end the episode.
        reason: why, in words.
        sequence: how the whole sequence was chosen, where it was chosen just now.
    """

    instance: SkillInstance | None
    reason: str = ""
    sequence: Choice | None = None

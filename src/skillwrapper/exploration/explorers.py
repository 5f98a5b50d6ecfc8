"""Who says what to try next: given the situation, the next skill or the end of the episode."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np

from skillwrapper.errors import UnknownNameError
from skillwrapper.exploration.explorer import Explorer as SequenceChooser
from skillwrapper.exploration.explorer import SequenceProposer
from skillwrapper.exploration.explorer import Situation as SequenceSituation
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.repair import random_sequence
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.exploration.situation import NextSkill, Situation
from skillwrapper.learning.untested import find_untested
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.skills import SkillInstance, ground_skills

__all__ = [
    "EXPLORERS",
    "Explorer",
    "NextSkill",
    "RandomExplorer",
    "SequenceExplorer",
    "Situation",
    "make_explorer",
]


class Explorer(Protocol):
    """Chooses what to try; same situations and episodes, in the same order, give same choices."""

    def next_skill(self, situation: Situation) -> NextSkill:
        """The next skill to run, or the end of the episode."""
        ...

    def record(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        ...


class SequenceExplorer:
    """The paper's way: a model proposes sequences, one is chosen and run to its end (D16)."""

    def __init__(
        self, domain: Domain, proposer: SequenceProposer, settings: ExplorationSettings, seed: int
    ) -> None:
        self._chooser = SequenceChooser(domain, proposer, settings, seed)
        self._sequence: tuple[SkillInstance, ...] = ()

    def next_skill(self, situation: Situation) -> NextSkill:
        """The next one of the sequence; at the start of an episode a sequence is chosen."""
        position, choice = len(situation.done), None
        if position == 0:
            choice = self._chooser.choose(
                SequenceSituation(
                    situation.scene.objects,
                    situation.observation,
                    situation.state,
                    situation.fit.model,
                    find_untested(situation.fit),
                )
            )
            self._sequence = choice.sequence
        if position >= len(self._sequence):
            return NextSkill(None, "the sequence has ended")
        reason = f"step {position + 1} of {len(self._sequence)} of the chosen sequence"
        return NextSkill(self._sequence[position], reason, choice)

    def record(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        self._chooser.record(episode)


class RandomExplorer:
    """Draws skill instances by chance, none twice in a row; looks at nothing."""

    def __init__(
        self, domain: Domain, proposer: SequenceProposer, settings: ExplorationSettings, seed: int
    ) -> None:
        self._domain, self._chance = domain, np.random.default_rng(seed)

    def next_skill(self, situation: Situation) -> NextSkill:
        """Any skill instance of the scene but the one that was run last."""
        allowed = ground_skills(self._domain.skills, situation.scene.objects)
        last = [transition.instance for transition in situation.done[-1:]]
        (drawn,) = random_sequence(allowed, 1, self._chance, after=last)
        return NextSkill(drawn, "drawn by chance")

    def record(self, episode: Episode) -> None:
        """Nothing is remembered."""


MakeExplorer = Callable[[Domain, SequenceProposer, ExplorationSettings, int], Explorer]
EXPLORERS: Mapping[str, MakeExplorer] = {
    "planned": lambda domain, _, settings, seed: PlannedExplorer(domain, settings, seed),
    "paper": SequenceExplorer,
    "random": RandomExplorer,
}
"""The explorers by their names."""


def make_explorer(
    domain: Domain, proposer: SequenceProposer, settings: ExplorationSettings, seed: int
) -> Explorer:
    """The explorer that the settings name.

    Raises:
        UnknownNameError: if there is none of this name.
    """
    if settings.explorer not in EXPLORERS:
        raise UnknownNameError("explorer", settings.explorer, EXPLORERS)
    return EXPLORERS[settings.explorer](domain, proposer, settings, seed)

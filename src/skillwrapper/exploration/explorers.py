"""The explorers by their names."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from skillwrapper.errors import UnknownNameError
from skillwrapper.exploration.explorer import Explorer, NextSkill, Situation
from skillwrapper.exploration.mixed import MixedExplorer
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.proposed import SequenceExplorer, random_sequence
from skillwrapper.exploration.questions import SequenceProposer
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.skills import ground_skills


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
    "mixed": MixedExplorer,
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

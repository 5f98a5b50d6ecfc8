"""Exploring by plan, where proposed sequences compete by the same measure."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.proposed import SequenceExplorer
from skillwrapper.exploration.questions import SequenceProposer
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.skills import SkillInstance

_WHY = (
    "follows proposed sequence {number}, {steps} more to go: each of its skills is worth more than "
    "a step of any plan"
)


class MixedExplorer:
    """Plans; a sequence that a model proposed is followed where it is worth more for its length.

    Sequences are asked for at the start of an episode. One of them stays in question as long as
    what was done is how it begins; it is worth what its skills are worth together, up to the one
    where that is most for each skill.

    Args:
        domain: types and skills.
        proposer: proposes sequences.
        settings: how far to look, and how many sequences to ask for.
        seed: decides between what is worth the same.
    """

    def __init__(
        self, domain: Domain, proposer: SequenceProposer, settings: ExplorationSettings, seed: int
    ) -> None:
        self._planned = PlannedExplorer(domain, settings, seed)
        self._proposed = SequenceExplorer(domain, proposer, settings, seed)
        self._sequences: list[tuple[SkillInstance, ...]] = []

    def next_skill(self, situation: Situation) -> NextSkill:
        """The next skill of the plan, or of a sequence that is better."""
        thought = self._planned.think(situation)
        if not situation.done:
            self._sequences, _ = self._proposed.propose(situation)
        best, following = float(thought.scores.max(initial=0.0)), None
        for number, rest in self._in_question(situation):
            values = self._planned.follow(situation, rest)
            shares = np.cumsum(values) / np.arange(1, len(rest) + 1)
            if shares.max() > best:
                best, steps = float(shares.max()), int(shares.argmax()) + 1
                following = NextSkill(rest[0], _WHY.format(number=number, steps=steps))
        return following or self._planned.choose(situation, thought)

    def _in_question(self, situation: Situation) -> Iterator[tuple[int, tuple[SkillInstance, ...]]]:
        """What is left of the sequences that began with what was done, with their numbers."""
        done = tuple(transition.instance for transition in situation.done)
        for number, sequence in enumerate(self._sequences, start=1):
            rest = sequence[len(done) : len(done) + situation.left]
            if rest and sequence[: len(done)] == done:
                yield number, rest

    def record(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        self._planned.record(episode)
        self._proposed.record(episode)

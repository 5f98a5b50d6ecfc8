"""How many calls reading pictures takes, beside what it would take without remembering labels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.world.observation import Observation
from skillwrapper.world.types import Object


@dataclass
class ReadingCalls:
    """Counts calls of the role ``evaluate``; those of ``summarise`` are as many at most.

    Replies that are asked for again are left out, on both sides.

    Attributes:
        truth: the labels, and how they were asked for.
        batch_size: groundings judged in one call, at most.
        votes: how often every grounding is judged.
        reasking: what it would take to ask every predicate on every new picture, and every
            predicate on every picture after each invention.
    """

    truth: TruthTable
    batch_size: int
    votes: int
    reasking: int = 0
    _arrived: dict[tuple[Object, ...], int] = field(default_factory=dict)

    @property
    def needed(self) -> int:
        """Calls that were needed, from a store or not."""
        sizes = self.truth.question_sizes.items()
        return sum(times * self._calls(groundings) for groundings, times in sizes)

    def count_arrival(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Count what reading the pictures that are new would take.

        Args:
            wanted: the whole vocabulary and all pictures of each scene, in order of time.
        """
        for space, observations in wanted:
            new = len(observations) - self._arrived.get(space.objects, 0)
            self._arrived[space.objects] = len(observations)
            self.reasking += new * self._calls(len(space.atoms))

    def count_invention(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Count what asking everything once more would take.

        Args:
            wanted: the whole vocabulary, the candidate included, and all pictures of each scene.
        """
        for space, observations in wanted:
            self.reasking += len(observations) * self._calls(len(space.atoms))

    def _calls(self, groundings: int) -> int:
        return -(-groundings // self.batch_size) * self.votes

"""How many calls reading pictures takes, beside what it would take without remembering labels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.symbols import AtomSpace
from skillwrapper.world.observation import Observation


@dataclass
class ReadingCalls:
    """Counts calls of the role ``evaluate``; those of ``summarise`` are as many.

    Replies that are asked for again are left out, on both sides.

    Attributes:
        truth: the labels, and how they were asked for.
        batch_size: groundings judged in one call, at most.
        votes: how often every grounding is judged.
        reasking: what asking every predicate on every picture after each invention would take.
    """

    truth: TruthTable
    batch_size: int
    votes: int
    reasking: int = 0

    @property
    def needed(self) -> int:
        """Calls that were needed, from a store or not."""
        sizes = self.truth.question_sizes.items()
        return sum(times * self._calls(groundings) for groundings, times in sizes)

    def count_invention(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Count what asking everything once more would take.

        Args:
            wanted: the whole vocabulary, the candidate included, and all pictures of each scene.
        """
        for space, observations in wanted:
            self.reasking += len(observations) * self._calls(len(space.atoms))

    def _calls(self, groundings: int) -> int:
        return -(-groundings // self.batch_size) * self.votes

"""What a run recorded, iteration by iteration, as the report needs it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.records import DecisionRecord, SummaryRecord
from skillwrapper.world.episode import Episode, Transition


@dataclass(frozen=True)
class DatedDecision:
    """What was decided of a predicate, and when.

    Attributes:
        iteration: when, from 1.
        record: what.
    """

    iteration: int
    record: DecisionRecord


@dataclass(frozen=True)
class Iteration:
    """One finished iteration.

    Attributes:
        number: from 1.
        episodes: what was executed.
        decisions: what was decided, in order.
        summary: figures at its end.
    """

    number: int
    episodes: tuple[Episode, ...]
    decisions: tuple[DecisionRecord, ...]
    summary: SummaryRecord

    @property
    def transitions(self) -> tuple[Transition, ...]:
        """What was executed, skill by skill."""
        return tuple(t for episode in self.episodes for t in episode.transitions)

    @property
    def executions(self) -> int:
        """How many skills were executed in this iteration."""
        return len(self.transitions)

    @property
    def successes(self) -> int:
        """How many of them succeeded."""
        return sum(t.success for t in self.transitions)

    @property
    def lasting(self) -> tuple[DecisionRecord, ...]:
        """The decisions that changed the vocabulary."""
        return tuple(d for d in self.decisions if d.verdict != "rejected")

    @property
    def rejected(self) -> tuple[DecisionRecord, ...]:
        """The candidates that were not taken."""
        return tuple(d for d in self.decisions if d.verdict == "rejected")


@dataclass(frozen=True)
class RunHistory:
    """All finished iterations of a run.

    Attributes:
        iterations: in order.
    """

    iterations: tuple[Iteration, ...]

    @classmethod
    def read(cls, archive: RunArchive) -> RunHistory:
        """Read what is finished.

        Raises:
            UserError: if a file is missing or damaged.
        """
        done, episodes, earlier = [], archive.episodes(), 0
        for found in archive.iterations():
            own = episodes[earlier : found.episodes]
            done.append(Iteration(found.number, own, found.decisions, found.summary))
            earlier = found.episodes
        return cls(tuple(done))

    @property
    def episodes(self) -> tuple[Episode, ...]:
        """All episodes."""
        return tuple(e for i in self.iterations for e in i.episodes)

    @cached_property
    def transitions(self) -> tuple[Transition, ...]:
        """All transitions; certificate and inconsistencies count them from 0."""
        return tuple(t for i in self.iterations for t in i.transitions)

    @property
    def successes(self) -> int:
        """How many executions succeeded."""
        return sum(i.successes for i in self.iterations)

    def origin(self, signature: str) -> DatedDecision | None:
        """The decision that last brought a predicate in, by signature or else by name.

        A predicate that was widened to another type (docs/semantics.md D3) has kept its name only.
        """
        name = signature.partition("(")[0]
        brought = [
            d
            for d in self.decisions()
            if d.record.verdict in ("accepted", "revived") and d.record.inconsistency
        ]
        exact = [d for d in brought if d.record.predicate == signature]
        fitting = exact or [d for d in brought if d.record.name == name]
        return fitting[-1] if fitting else None

    def decisions(self) -> Iterator[DatedDecision]:
        """All decisions in order of time."""
        for iteration in self.iterations:
            for record in iteration.decisions:
                yield DatedDecision(iteration.number, record)

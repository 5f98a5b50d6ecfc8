"""How models are asked."""

from __future__ import annotations

from dataclasses import dataclass

from skillwrapper.errors import ConfigurationError


@dataclass(frozen=True)
class AssistantSettings:
    """How models are asked; nothing here changes what a single reply means.

    Attributes:
        parallel: calls in flight at the same time; with 1 there are no threads.
        batch_size: groundings judged in one call, at most.
        reasks: how often groundings are asked for again that a reply left out.
        unusable_reasks: how often a question is asked again whose whole reply was of no use.
        votes: how often every grounding is judged, independently.
        margin: by what share of the votes the majority must lead, 0 to 1; a tie or a smaller
            lead makes the label unknown.

    Raises:
        ConfigurationError: if a number makes no sense.
    """

    parallel: int = 1
    batch_size: int = 60
    reasks: int = 2
    unusable_reasks: int = 4
    votes: int = 1
    margin: float = 0.0

    def __post_init__(self) -> None:
        least_values = {
            "parallel": 1,
            "batch_size": 1,
            "reasks": 0,
            "unusable_reasks": 0,
            "votes": 1,
        }
        for name, least in least_values.items():
            value = getattr(self, name)
            if value < least:
                raise ConfigurationError(f"'{name}': expected at least {least}, got {value}")
        if not 0 <= self.margin <= 1:
            raise ConfigurationError(f"'margin': expected 0 to 1, got {self.margin}")

    @property
    def most_repetitions(self) -> int:
        """How often one vote on one batch of groundings is asked for at most."""
        return 1 + self.reasks + self.unusable_reasks

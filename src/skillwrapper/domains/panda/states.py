"""The abstract states of the table: what is held, what is on the plate, what became of things."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from skillwrapper.errors import ConfigurationError

ROBOT: Final = "robot"
MUG, TEAPOT, PLATE, BOWL, SPONGE = "mug", "teapot", "plate", "bowl", "sponge"
THINGS: Final = (MUG, TEAPOT, PLATE, BOWL, SPONGE)
PICKUPABLE: Final = (TEAPOT, BOWL, SPONGE)


@dataclass(frozen=True, order=True)
class PandaState:
    """One state of the table; what is neither held nor on the plate stands where it started.

    Attributes:
        held: the thing in the gripper; None for nothing.
        stacked: the thing on the plate; None for nothing.
        dirty: whether there is residue of food on the plate.
        full: whether there is tea in the mug.

    Raises:
        ConfigurationError: if things cannot be so.
    """

    held: str | None = None
    stacked: str | None = None
    dirty: bool = False
    full: bool = False

    def __post_init__(self) -> None:
        for thing in (self.held, self.stacked):
            if thing is not None and thing not in PICKUPABLE:
                raise ConfigurationError(f"expected one of {', '.join(PICKUPABLE)}, got '{thing}'")
        if self.held is not None and self.held == self.stacked:
            raise ConfigurationError(f"expected the {self.held} in one place, got two")


def start_of(present: Iterable[str]) -> PandaState:
    """The state in which a scene starts; a plate waits dirty where there is a sponge for it."""
    return PandaState(dirty={PLATE, SPONGE} <= set(present))

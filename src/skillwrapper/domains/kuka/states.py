"""The abstract states: where jar and knife are, and what became of jar, blade and bread."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal

from skillwrapper.errors import ConfigurationError

ROBOT: Final = "robot"
JAR, KNIFE, BREAD = "jar", "knife", "bread"
THINGS: Final = (JAR, KNIFE, BREAD)

IN_HOLDER: Final = "holder"
IN_HAND: Final = "hand"
ON_TABLE: Final = "table"
CLEAN: Final = "clean"
COATED: Final = "coated"
USED: Final = "used"


KnifePlace = Literal["holder", "hand", "table"]
Blade = Literal["clean", "coated", "used"]


@dataclass(frozen=True, order=True)
class KukaState:
    """One state of the two arms' table; those that cannot come about are refused.

    An open jar outside the hand is none of the 13 states that skills lead to; it may slip there.

    Attributes:
        jar_held: whether the left hand holds the jar, which else stands where it started.
        opened: whether the jar's lid is off.
        knife: in its holder, in the right hand, or lying on the table.
        blade: clean, coated with peanut butter, or used: what was on it is on the bread.

    Raises:
        ConfigurationError: if things cannot be so.
    """

    jar_held: bool = False
    opened: bool = False
    knife: KnifePlace = IN_HOLDER
    blade: Blade = CLEAN

    def __post_init__(self) -> None:
        if self.blade != CLEAN and not self.opened:
            raise ConfigurationError(f"expected a clean blade with a closed jar, got {self.blade}")
        if self.blade != CLEAN and self.knife == IN_HOLDER:
            raise ConfigurationError(f"expected a clean blade in the holder, got {self.blade}")

    @property
    def spread(self) -> bool:
        """Whether there is peanut butter on the bread."""
        return self.blade == USED

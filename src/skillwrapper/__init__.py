"""skillwrapper: symbolic planning models of black-box robot skills, learned from pictures."""

from skillwrapper.world.episode import Outcome
from skillwrapper.world.robot import Robot

__version__ = "0.1.0"

__all__ = ["Outcome", "Robot"]

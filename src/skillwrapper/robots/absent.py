"""A robot that is not there: for learning from what is recorded already."""

from __future__ import annotations

from typing import NoReturn

from skillwrapper.errors import RobotError
from skillwrapper.world.robot import Robot


class AbsentRobot(Robot):
    """Refuses to do anything."""

    def look(self) -> NoReturn:
        """Refuse.

        Raises:
            RobotError: always.
        """
        raise RobotError("expected only what is recorded to be used, got a call to look()")

    def run(self, skill: str, *arguments: str) -> NoReturn:
        """Refuse.

        Raises:
            RobotError: always.
        """
        raise RobotError(f"expected only what is recorded to be used, got a call to run {skill}")

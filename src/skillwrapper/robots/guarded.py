"""Running one skill with a time limit and an eye on the emergency stop."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from skillwrapper.errors import EmergencyStopError, RobotError, SkillWrapperError
from skillwrapper.world.capabilities import Haltable, require, supports
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Outcome
from skillwrapper.world.skills import SkillInstance

_LOOK_EVERY = 0.05
"""Seconds between two looks at the emergency stop."""


@dataclass
class _Call:
    """A call in a thread of its own: its result, or what it raised."""

    call: Callable[[], Outcome]
    outcome: Outcome | None = None
    error: BaseException | None = None
    done: threading.Event = field(default_factory=threading.Event)

    def run(self) -> None:
        try:
            self.outcome = self.call()
        except BaseException as error:  # raised again where it is waited for
            self.error = error
        finally:
            self.done.set()


def check_halted(environment: Environment, running: SkillInstance | None = None) -> None:
    """Raise if nothing may move now.

    Args:
        environment: the robot.
        running: what it runs, or has just run; None between two skills.

    Raises:
        EmergencyStopError: with the reason that the robot gives.
    """
    if supports(environment, Haltable):
        reason = require(environment, Haltable, "the emergency stop").halted()
        if reason is not None:
            where = f"{running}: " if running else ""
            raise EmergencyStopError(f"{where}emergency stop: {reason or 'no reason given'}")


def execute_guarded(environment: Environment, instance: SkillInstance, limit: float) -> Outcome:
    """Execute a skill instance, and wait no longer than a limit.

    A skill that hangs goes on in a thread that dies with the program; nothing else is asked of the
    robot afterwards but to stop.

    Args:
        environment: the robot.
        instance: what to run.
        limit: seconds.

    Raises:
        EmergencyStopError: if the robot says before, during or after it that nothing may move.
        RobotError: if it takes longer, or the robot itself fails.
        UserError: if there is no such skill instance.
    """
    check_halted(environment)
    running = _Call(lambda: environment.execute(instance))
    threading.Thread(target=running.run, daemon=True, name=f"skill {instance}").start()
    deadline = time.monotonic() + limit
    while not running.done.wait(_LOOK_EVERY):
        check_halted(environment, instance)
        if time.monotonic() > deadline:
            raise RobotError(f"{instance}: expected an end within {limit:g} s, got none")
    if running.error is not None:
        raise _as_robot_error(running.error, instance) from running.error
    check_halted(environment, instance)
    if running.outcome is None:
        raise RobotError(f"{instance}: expected an outcome, got none")
    return running.outcome


def _as_robot_error(error: BaseException, instance: SkillInstance) -> BaseException:
    if isinstance(error, SkillWrapperError) or not isinstance(error, Exception):
        return error
    return RobotError(f"{instance}: {type(error).__name__}: {error}")

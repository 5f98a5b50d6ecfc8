"""The options that say who runs the skills: the domain's robot, a process, a person, or nobody."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError
from skillwrapper.robots.by_hand import HandRobot
from skillwrapper.robots.process import ProcessRobot
from skillwrapper.world.environment import Environment
from skillwrapper.world.robot import RobotEnvironment

RobotOption = Annotated[
    str | None,
    typer.Option(
        "--robot", help="Command of a process that runs the skills, in place of the domain's robot."
    ),
]
RobotTimeoutOption = Annotated[
    float, typer.Option(min=0.1, help="Seconds that a call to that process may take.")
]
ByHandOption = Annotated[
    bool, typer.Option("--by-hand", help="Be told which skill to run, and say how it went.")
]
CameraOption = Annotated[
    str | None,
    typer.Option(help="By hand: a command that takes a picture into the file %o."),
]


def person(camera: str | None) -> HandRobot:
    """Whoever sits at the keyboard."""
    return HandRobot(ask, camera)


def ask(question: str) -> str:
    """Put a question on standard error; the answer is a line of standard input."""
    typer.echo(question, nl=False, err=True)
    return input()


def check_ways(robot: str | None, by_hand: bool, camera: str | None) -> None:
    """Refuse what does not go together.

    Raises:
        ConfigurationError: if two ways are given, or a camera without a hand.
    """
    if robot is not None and by_hand:
        raise ConfigurationError("expected one of --robot and --by-hand, got both")
    if camera is not None and not by_hand:
        raise ConfigurationError("--camera: expected it with --by-hand only")


@contextmanager
def environment_of(
    domain: str,
    robot: str | None = None,
    timeout: float = 300.0,
    by_hand: bool = False,
    camera: str | None = None,
) -> Iterator[Environment]:
    """The environment of a domain with whoever runs its skills; is closed at the end."""
    check_ways(robot, by_hand, camera)
    package = find_domain(domain)
    environment: Environment
    if by_hand:
        environment = RobotEnvironment(person(camera), package.domain)
    elif robot is not None:
        process = ProcessRobot(robot, package.domain.name, timeout)
        environment = RobotEnvironment(process, package.domain)
    else:
        environment = package.make_environment()
    try:
        yield environment
    finally:
        environment.close()


def run_folder(out: Path | None, purpose: str) -> Path:
    """The folder that must be given.

    Raises:
        ConfigurationError: if it is not.
    """
    if out is None:
        raise ConfigurationError(f"expected --out DIR for {purpose}, got none")
    return out

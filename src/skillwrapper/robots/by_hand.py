"""A person runs the skills: is told which, says how it went, and lets a camera look."""

from __future__ import annotations

import shlex
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

from skillwrapper.errors import ConfigurationError, LimitReachedError, PictureError, RobotError
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_pictures
from skillwrapper.world.robot import Robot

Ask = Callable[[str], str]
"""Puts a question to the person, and gives what was typed."""

_OUTPUT = "%o"
_ANSWERS = "s(uccess), f(ailure), u(ndo the last skill), k (skip this skill), q(uit)"


class UndoRequestedError(RobotError):
    """The person wants to take back what was reported last."""


class SkipRequestedError(RobotError):
    """The person does not want to run this skill; another episode may begin."""


class LeftError(LimitReachedError):
    """The person leaves; the same command goes on later."""


class HandRobot(Robot):
    """A person.

    Args:
        ask: puts questions.
        camera: command that takes a picture into the file ``%o``; None to ask for a file.
        limit: seconds that the camera may take.

    Raises:
        ConfigurationError: if the command does not say where the picture goes.
    """

    lasting = True

    def __init__(self, ask: Ask, camera: str | None = None, limit: float = 60.0) -> None:
        self._ask, self._limit = ask, limit
        self._camera = _split(camera) if camera is not None else None

    def prepare(self, seed: int, scene: str = "") -> None:
        """Let the person set up a start."""
        if self._answer(f"Set up {scene or 'the world'}, then press Enter (q to leave): ") == "q":
            raise LeftError("left; the same command goes on later")

    def look(self) -> Observation:
        """Take a picture, or ask for one until there is one."""
        if self._camera is not None:
            return self._take_picture(self._camera)
        while True:
            typed = self._answer("Picture, as FILE or CAMERA=FILE CAMERA=FILE (q to leave): ")
            if typed == "q":
                raise LeftError("left; the same command goes on later")
            try:
                return load_pictures(shlex.split(typed) or [""])
            except (PictureError, ValueError) as error:
                self._ask(f"{error}\nPress Enter to try again. ")

    def run(self, skill: str, *arguments: str) -> bool:
        """Say which skill to run, and wait for how it went.

        Raises:
            UndoRequestedError: if the last one is to be taken back.
            SkipRequestedError: if this one is not to be run.
            LeftError: if the person leaves.
        """
        call = f"{skill}({', '.join(arguments)})"
        while True:
            match self._answer(f"Run {call}. How did it go? {_ANSWERS}: "):
                case "s" | "success" | "y" | "yes":
                    return True
                case "f" | "failure" | "n" | "no":
                    return False
                case "u" | "undo":
                    raise UndoRequestedError(f"asked to undo what came before {call}")
                case "k" | "skip":
                    raise SkipRequestedError(f"{call} was skipped")
                case "q" | "quit":
                    raise LeftError("left; the same command goes on later")

    def _answer(self, question: str) -> str:
        try:
            return self._ask(question).strip()
        except EOFError as error:
            raise LeftError(
                "left at the end of the input; the same command goes on later"
            ) from error

    def _take_picture(self, words: list[str]) -> Observation:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "picture.png"
            command = [word.replace(_OUTPUT, str(file)) for word in words]
            try:
                done = subprocess.run(
                    command, capture_output=True, timeout=self._limit, check=False, text=True
                )
            except subprocess.TimeoutExpired as error:
                message = f"camera: expected a picture within {self._limit:g} s, got none"
                raise RobotError(message) from error
            except OSError as error:
                raise ConfigurationError(f"camera: {words[0]}: {error.strerror}") from error
            if done.returncode:
                last = (done.stderr.strip() or "no message").splitlines()[-1]
                raise RobotError(f"camera: exit code {done.returncode}: {last}")
            return load_pictures([str(file)])


def _split(camera: str) -> list[str]:
    try:
        words = shlex.split(camera)
    except ValueError as error:
        raise ConfigurationError(f"--camera: expected a command, got {error}") from error
    if not any(_OUTPUT in word for word in words):
        raise ConfigurationError(
            f"--camera: expected a command with {_OUTPUT} for the file of the picture, "
            f"got '{camera}'"
        )
    return words

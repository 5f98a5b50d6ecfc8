"""A robot in another process: another Python, ROS, C++ (``--robot 'command'``)."""

from __future__ import annotations

import json
from collections.abc import Iterable
from types import TracebackType
from typing import Any, Self, TypeVar

from pydantic import ValidationError

from skillwrapper.errors import RobotError
from skillwrapper.files.mistakes import first_mistake, shorten
from skillwrapper.robots.line_process import LineProcess
from skillwrapper.robots.messages import (
    PROTOCOL,
    Answer,
    HelloAnswer,
    LookAnswer,
    PrepareAnswer,
    RunAnswer,
    unpack_picture,
)
from skillwrapper.world.episode import Outcome
from skillwrapper.world.pictures import Look, observation_of
from skillwrapper.world.robot import Robot, RunResult

Kind = TypeVar("Kind", bound=Answer)

_PATIENCE = 0.4
"""Seconds that a process has to end by itself where we are stopped, and to end when it is told."""
_SHOWN = 80
"""Characters of a wrong answer that are quoted."""


class ProcessRobot(Robot):
    """Speaks to a command, one JSON object a line (``skillwrapper.robots.messages``).

    Args:
        command: starts the robot's process.
        domain: name of the domain.
        limit: seconds that a call may take.

    Raises:
        ConfigurationError: if there is no such command.
        RobotError: if it does not answer as it should.
    """

    def __init__(self, command: str, domain: str, limit: float = 300.0) -> None:
        self._name, self._limit = f"robot {shorten(repr(command))}", limit
        self._process = LineProcess(command)
        self._scene: str | list[str] | None = None
        self._is_stopped = False
        try:
            hello = self._ask(
                {"call": "hello", "protocol": PROTOCOL, "domain": domain}, HelloAnswer
            )
            if hello.protocol != PROTOCOL:
                raise RobotError(
                    f"{self._name}: hello: expected protocol {PROTOCOL}, got {hello.protocol}"
                )
        except RobotError:
            self._process.close()
            raise
        self.replayable, self.lasting = hello.replayable, hello.lasting

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is None:
            self.stop()
        else:
            self._is_stopped = True
            self._process.close(_PATIENCE)

    def prepare(self, seed: int, scene: str = "") -> None:
        """Let it bring the world to a start."""
        call = {"call": "prepare", "seed": seed, "scene": scene}
        self._scene = self._ask(call, PrepareAnswer).scene

    def scene(self) -> str | Iterable[str] | None:
        """What it said after ``prepare``."""
        return self._scene

    def look(self) -> Look:
        """Let it look."""
        pictures = self._ask({"call": "look"}, LookAnswer).pictures
        return {camera: unpack_picture(text) for camera, text in pictures.items()}

    def run(self, skill: str, *arguments: str) -> RunResult:
        """Let it run a skill."""
        call = {"call": "run", "skill": skill, "arguments": list(arguments)}
        answer = self._ask(call, RunAnswer)
        if answer.success is None:
            raise RobotError(f"{self._name}: {_named(call)}: expected 'success', got none")
        if answer.changed is None:
            return answer.success, answer.message
        seen = observation_of(self.look())
        return Outcome(answer.success, seen, answer.message, answer.changed)

    def stop(self) -> None:
        """Let it stop, and end the process; the second time nothing happens."""
        if self._is_stopped:
            return
        self._is_stopped = True
        try:
            self._ask({"call": "stop"}, Answer)
        finally:
            self._process.close()

    def _ask(self, call: dict[str, Any], kind: type[Kind]) -> Kind:
        what = _named(call)
        line = self._process.ask(json.dumps(call), what, self._limit)
        try:
            answer = kind.model_validate_json(line)
        except ValidationError as error:
            raise RobotError(f"{self._name}: {what}: {_explain(line, error, kind)}") from error
        if answer.error is not None:
            reason = answer.error.strip() or "an error for which it gives no reason"
            raise RobotError(f"{self._name}: {what}: {reason}")
        return answer


def _named(call: dict[str, Any]) -> str:
    if call["call"] == "run":
        return f"run {call['skill']}({', '.join(call['arguments'])})"
    return str(call["call"])


def _explain(line: bytes, error: ValidationError, kind: type[Answer]) -> str:
    """What is wrong with an answer."""
    try:
        is_object = isinstance(json.loads(line), dict)
    except (ValueError, RecursionError):
        is_object = False
    if is_object:
        return first_mistake(error, kind).text
    text = line.decode("utf-8", "replace")
    shown = text[:_SHOWN] + ("..." if len(text) > _SHOWN else "")
    return f"expected one JSON object in a line, got {shown!r}; other things go to standard error"

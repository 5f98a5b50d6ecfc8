"""The other end: letting any environment be a robot in another process."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, TextIO

from skillwrapper.errors import SkillWrapperError
from skillwrapper.robots.messages import PROTOCOL, pack_picture
from skillwrapper.world.capabilities import Lasting, Replayable, supports
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation
from skillwrapper.world.robot import RobotEnvironment
from skillwrapper.world.skills import SkillInstance


def serve(environment: Environment, calls: Iterable[str], answers: TextIO) -> None:
    """Answer calls until they end, or until ``stop``.

    Args:
        environment: the robot.
        calls: lines, e.g. the standard input.
        answers: where lines are written, e.g. the standard output.
    """
    server = _Server(environment)
    for line in calls:
        call: Any = None
        try:
            call = json.loads(line)
            answer = server.answer(call)
        except SkillWrapperError as error:
            answer = {"error": str(error)}
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            answer = {"error": f"expected a call, got {line.strip()[:80]!r} ({error})"}
        answers.write(json.dumps(answer) + "\n")
        answers.flush()
        if isinstance(call, dict) and call.get("call") == "stop":
            return


class _Server:
    """Answers single calls; what was seen by the last skill is shown by the next look."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment
        self._seen: Observation | None = None
        self._is_ready = False

    def answer(self, call: dict[str, Any]) -> dict[str, Any]:
        """What a call is answered with."""
        match call["call"]:
            case "hello":
                return {
                    "protocol": PROTOCOL,
                    "replayable": supports(self._environment, Replayable),
                    "lasting": supports(self._environment, Lasting),
                }
            case "prepare":
                self._is_ready = True
                self._seen = self._environment.reset(seed=call["seed"], scene=call["scene"])
                return {"scene": list(self._environment.scene.names)}
            case "look":
                self._take_up()
                seen, self._seen = self._seen or self._environment.observe(), None
                return {"pictures": {p.camera: pack_picture(p.png) for p in seen.pictures}}
            case "run":
                return self._run(SkillInstance(call["skill"], tuple(call["arguments"])))
            case "stop":
                self._environment.close()
                return {}
        return {"error": f"expected hello, prepare, look, run or stop, got {call['call']!r}"}

    def _take_up(self) -> None:
        """Stand ready as the robot stands, if nobody asked it to prepare a start."""
        if not self._is_ready and isinstance(self._environment, RobotEnvironment):
            self._environment.take_up(self._environment.present())
        self._is_ready = True

    def _run(self, instance: SkillInstance) -> dict[str, Any]:
        self._take_up()
        outcome = self._environment.execute(instance)
        self._seen = outcome.observation
        told = {"success": outcome.success, "message": outcome.message}
        return told if outcome.changed is None else {**told, "changed": outcome.changed}

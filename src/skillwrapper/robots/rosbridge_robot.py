"""A robot under ROS 2, reached through rosbridge: skills are actions or services, cameras topics.

In ``robot.py`` of a domain::

    def make_robot():
        return RosbridgeRobot.connect(
            {"Pick": RosAction("/pick", "my_msgs/action/Pick", lambda arm, cube: {"object": cube})},
            {"front": "/camera/image_raw/compressed"},
        )
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Self, TypeAlias

from skillwrapper.errors import MissingDependencyError, RobotError
from skillwrapper.redaction import safe_address
from skillwrapper.robots.ros_pictures import message_type, picture_of
from skillwrapper.world.pictures import Look
from skillwrapper.world.robot import Robot

_LOOK_EVERY = 0.1
"""Seconds between two looks at the connection."""
_SETTLE = 0.5
"""Seconds to wait for a second picture; the first may have been under way before the look."""
_SUCCEEDED = 4
"""``action_msgs/msg/GoalStatus.STATUS_SUCCEEDED``."""
_ENDED = {_SUCCEEDED: "succeeded", 5: "canceled", 6: "aborted"}

Verdict: TypeAlias = "bool | tuple[bool, str]"


def _says_success(values: Mapping[str, Any]) -> Verdict:
    """As in ``std_srvs/srv/Trigger``."""
    return bool(values["success"]), str(values.get("message", ""))


@dataclass(frozen=True)
class RosAction:
    """A skill that is an action.

    Attributes:
        name: of the action, e.g. ``/pick``.
        type: e.g. ``my_msgs/action/Pick``.
        goal: the fields of the goal, from the skill's arguments.
        succeeded: whether it did, perhaps with a message, from the fields of the result of an
            action that ended as succeeded; None if that says it all.
    """

    name: str
    type: str
    goal: Callable[..., Mapping[str, Any]]
    succeeded: Callable[[Mapping[str, Any]], Verdict] | None = None


@dataclass(frozen=True)
class RosService:
    """A skill that is a service.

    Attributes:
        name: of the service, e.g. ``/open_gripper``.
        type: e.g. ``std_srvs/srv/Trigger``.
        request: the fields of the request, from the skill's arguments.
        succeeded: whether it did, perhaps with a message, from the fields of the response; by
            default what its field ``success`` says.
    """

    name: str
    type: str
    request: Callable[..., Mapping[str, Any]] = lambda *arguments: {}
    succeeded: Callable[[Mapping[str, Any]], Verdict] = _says_success


RosSkill: TypeAlias = "RosAction | RosService"


@dataclass
class _Reply:
    """What comes back, in another thread."""

    values: Any = None
    problem: Any = None
    came: threading.Event = field(default_factory=threading.Event)

    def take(self, values: Any) -> None:
        self.values = values
        self.came.set()

    def fail(self, problem: Any) -> None:
        self.problem = problem
        self.came.set()


def _leave(ros: Any) -> None:
    """End a connection, or the tries to get one: roslibpy would go on with them for good."""
    ros.factory.manager.call_later(0, ros.factory.stopTrying)  # timers belong to its own thread
    ros.close()


class RosbridgeRobot(Robot):
    """Speaks to a rosbridge server.

    Args:
        ros: a connection of ``roslibpy`` that is up; ``connect`` makes one.
        skills: by their names in ``domain.yaml``.
        cameras: topics of images by the names of cameras; ``sensor_msgs/msg/CompressedImage`` if
            the topic ends in ``/compressed``, else ``sensor_msgs/msg/Image``.
        prepare: called with seed and scene to bring the world to a start; None for nothing.
        limit: seconds that a call, or a camera, may take.
    """

    def __init__(
        self,
        ros: Any,
        skills: Mapping[str, RosSkill],
        cameras: Mapping[str, str],
        *,
        prepare: RosSkill | None = None,
        limit: float = 300.0,
    ) -> None:
        self._ros, self._skills, self._cameras = ros, dict(skills), dict(cameras)
        self._prepare, self._limit = prepare, limit

    @classmethod
    def connect(
        cls,
        skills: Mapping[str, RosSkill],
        cameras: Mapping[str, str],
        *,
        host: str = "127.0.0.1",
        port: int = 9090,
        prepare: RosSkill | None = None,
        limit: float = 300.0,
        connecting: float = 10.0,
    ) -> Self:
        """Connect to a server; the arguments are those of the class.

        Raises:
            MissingDependencyError: if ``roslibpy`` is not installed.
            RobotError: if nobody answers within so many seconds of connecting.
        """
        try:
            import roslibpy  # noqa: PLC0415
        except ImportError as error:
            how = "pip install 'skillwrapper[ros]'"
            raise MissingDependencyError("roslibpy", how) from error
        ros = roslibpy.Ros(host, port)
        try:
            ros.run(connecting)
        except Exception as error:
            _leave(ros)
            raise RobotError(
                f"rosbridge at {safe_address(host)}:{port}: expected a connection within "
                f"{connecting:g} s, got none; start it with: "
                "ros2 launch rosbridge_server rosbridge_websocket_launch.xml"
            ) from error
        return cls(ros, skills, cameras, prepare=prepare, limit=limit)

    def prepare(self, seed: int, scene: str = "") -> None:
        """Let it bring the world to a start.

        Raises:
            RobotError: if that fails.
        """
        if self._prepare is not None:
            done = self._call(self._prepare, f"prepare({seed}, {scene})", seed, scene)
            success, message = done if isinstance(done, tuple) else (done, "")
            if not success:
                raise RobotError(f"prepare({seed}, {scene}): {message or 'it failed'}")

    def look(self) -> Look:
        """The second picture of every camera from now on, or the only one of a topic that is still.

        Raises:
            RobotError: if one does not come in time, or is in an encoding that is not known.
        """
        return {camera: self._see(camera, topic) for camera, topic in self._cameras.items()}

    def run(self, skill: str, *arguments: str) -> Verdict:
        """Run a skill.

        Raises:
            RobotError: if there is no such skill here, or it cannot be called, or does not end.
        """
        if skill not in self._skills:
            known = ", ".join(sorted(self._skills)) or "none"
            raise RobotError(f"expected a skill of {known}, got '{skill}'; name it in robot.py")
        return self._call(self._skills[skill], f"{skill}({', '.join(arguments)})", *arguments)

    def stop(self) -> None:
        """Close the connection, and look for no other where it was lost."""
        _leave(self._ros)

    def _call(self, skill: RosSkill, what: str, *arguments: Any) -> Verdict:
        if isinstance(skill, RosService):
            return skill.succeeded(self._serve(skill, what, *arguments))
        return self._act(skill, what, *arguments)

    def _serve(self, skill: RosService, what: str, *arguments: Any) -> Mapping[str, Any]:
        import roslibpy  # noqa: PLC0415

        reply = _Reply()
        request = roslibpy.ServiceRequest(dict(skill.request(*arguments)))
        service = roslibpy.Service(self._ros, skill.name, skill.type)
        service.call(request, reply.take, reply.fail)
        self._wait(reply, f"{what}: service {skill.name}")
        if reply.problem is not None:
            raise RobotError(f"{what}: service {skill.name}: {reply.problem}")
        return dict(reply.values)

    def _act(self, skill: RosAction, what: str, *arguments: Any) -> Verdict:
        import roslibpy  # noqa: PLC0415

        reply = _Reply()
        client = roslibpy.ActionClient(self._ros, skill.name, skill.type)
        goal = roslibpy.Goal(dict(skill.goal(*arguments)))
        number = client.send_goal(goal, reply.take, lambda feedback: None, reply.fail)
        try:
            self._wait(reply, f"{what}: action {skill.name}")
        except RobotError:
            client.cancel_goal(number)
            raise
        ended = reply.values if reply.problem is None else reply.problem
        status = int(getattr(ended["status"], "value", ended["status"]))
        if status not in _ENDED:
            raise RobotError(f"{what}: action {skill.name}: {ended['values'] or 'it was refused'}")
        if status != _SUCCEEDED:
            return False, _ENDED[status]
        return skill.succeeded(ended["values"]) if skill.succeeded else True

    def _see(self, camera: str, name: str) -> Any:
        import roslibpy  # noqa: PLC0415

        kind, reply, fresh = message_type(name), _Reply(), threading.Event()

        def take(message: Any) -> None:
            if reply.came.is_set():
                fresh.set()
            reply.take(message)

        topic = roslibpy.Topic(self._ros, name, kind, queue_length=1)
        topic.subscribe(take)
        try:
            self._wait(reply, f"camera {camera}: topic {name} ({kind})")
            fresh.wait(_SETTLE)
        finally:
            topic.unsubscribe()
        try:
            return picture_of(reply.values)
        except (KeyError, TypeError, ValueError) as error:
            raise RobotError(f"camera {camera}: topic {name} ({kind}): {error}") from error

    def _wait(self, reply: _Reply, what: str) -> None:
        deadline = time.monotonic() + self._limit
        while not reply.came.wait(_LOOK_EVERY):
            if not self._ros.is_connected:
                raise RobotError(f"{what}: expected an answer, but the connection was lost")
            if time.monotonic() > deadline:
                raise RobotError(f"{what}: expected an answer within {self._limit:g} s, got none")

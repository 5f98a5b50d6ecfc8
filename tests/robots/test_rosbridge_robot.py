"""A robot behind rosbridge: a real websocket, a real client, a server of our own."""

from __future__ import annotations

import base64
import sys
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from notebook import instance, make_domain

from skillwrapper.errors import MissingDependencyError, RobotError
from skillwrapper.robots.ros_pictures import message_type, picture_of
from skillwrapper.robots.rosbridge_robot import RosAction, RosbridgeRobot, RosService
from skillwrapper.world.conformance import check_environment
from skillwrapper.world.conformance_report import Level
from skillwrapper.world.robot import RobotEnvironment

pytest.importorskip("roslibpy", reason="the extra ros is not installed")
pytest.importorskip("websockets", reason="the server of this test needs websockets")

from rosbridge import LampServer

DOMAIN = make_domain(
    {"hand": (), "lamp": ()},
    {"hand": "hand", "left": "lamp", "right": "lamp"},
    {"Light": "hand lamp", "PutOut": "hand lamp", "Odd": "hand lamp"},
)


def lamp(hand: str, name: str) -> dict[str, str]:
    return {"lamp": name}


LIGHT = RosAction("/light", "lamps/action/Light", lamp)
PUT_OUT = RosService("/put_out", "lamps/srv/PutOut", lamp)
RESET = RosService("/reset", "lamps/srv/Reset", lambda seed, scene: {"seed": seed, "scene": scene})


@pytest.fixture
def server() -> Iterator[LampServer]:
    with LampServer() as serving:
        yield serving


class Robots:
    """Connects to the server as often as it is asked, and leaves no connection behind."""

    def __init__(self, server: LampServer) -> None:
        self._server, self.made = server, list[RobotEnvironment]()

    def __call__(self, odd: Any = LIGHT, limit: float = 20.0) -> RobotEnvironment:
        skills = {"Light": LIGHT, "PutOut": PUT_OUT, "Odd": odd}
        connected = RosbridgeRobot.connect(
            skills, {"front": "/camera"}, port=self._server.port, prepare=RESET, limit=limit
        )
        self.made.append(RobotEnvironment(connected, DOMAIN))
        return self.made[-1]


@pytest.fixture
def robot(server: LampServer) -> Iterator[Robots]:
    robots = Robots(server)
    yield robots
    for made in robots.made:
        made.close()


def test_it_keeps_the_rules(server: LampServer, robot: Robots) -> None:
    assert check_environment(robot, steps=15) is Level.ROBOT
    assert server.seeds[0][0] == 0


def test_actions_services_and_cameras_tell_what_happens(server: LampServer, robot: Robots) -> None:
    environment = robot()
    dark = environment.reset(seed=3)
    lit = environment.execute(instance("Light(hand, left)"))
    assert lit.success
    assert lit.observation.key != dark.key
    again = environment.execute(instance("Light(hand, left)"))
    assert (again.success, again.message) == (False, "aborted")
    wrong = environment.execute(instance("PutOut(hand, right)"))
    assert (wrong.success, wrong.message) == (False, "dark")
    assert environment.execute(instance("PutOut(hand, left)")).observation.key == dark.key
    server.encoding = "bgr8"
    assert environment.observe().key == dark.key
    server.encoding = "yuv422"
    with pytest.raises(RobotError, match=r"camera front: topic /camera .*'yuv422'"):
        environment.observe()


def test_nobody_looks_for_a_lost_connection_once_it_is_closed(robot: Robots) -> None:
    environment = robot(odd=RosService("/die", "x/srv/X"))
    environment.reset(seed=0)
    connection = environment._robot._ros.factory
    with pytest.raises(RobotError, match="the connection was lost"):
        environment.execute(instance("Odd(hand, left)"))
    environment.close()
    deadline = time.monotonic() + 10
    while connection.continueTrying:
        assert time.monotonic() < deadline
        time.sleep(0.01)
    assert not connection.is_connected


@pytest.mark.parametrize(
    ("skill", "words"),
    [
        (RosService("/broken", "x/srv/X"), "service /broken: no such service"),
        (RosAction("/refused", "x/action/X", lamp), "action /refused: .*no server"),
        (RosAction("/silent", "x/action/X", lamp), "action /silent: expected an answer within"),
        (RosService("/silent", "x/srv/X"), "service /silent: expected an answer within"),
        (RosService("/die", "x/srv/X"), "service /die: expected an answer, but the connection"),
    ],
)
def test_whatever_goes_wrong_is_named(
    server: LampServer, robot: Robots, skill: Any, words: str
) -> None:
    environment = robot(odd=skill, limit=0.5 if "silent" in skill.name else 20.0)
    environment.reset(seed=0)
    with pytest.raises(RobotError, match=rf"Odd\(hand, left\): {words}"):
        environment.execute(instance("Odd(hand, left)"))
    if skill.name == "/silent" and isinstance(skill, RosAction):
        environment.observe()  # goes through the same connection, so it has heard the other
        assert server.cancelled == 1


def test_a_start_that_fails_and_a_server_that_is_not_there(robot: Robots) -> None:
    with pytest.raises(RobotError, match=r"prepare\(-1, .*\): it failed"):
        robot().reset(seed=-1)
    with pytest.raises(RobotError, match=r"127\.0\.0\.1:1: expected a connection within 0.3 s"):
        RosbridgeRobot.connect({}, {}, port=1, connecting=0.3)


def test_without_roslibpy_it_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "roslibpy", None)
    with pytest.raises(MissingDependencyError, match=r"skillwrapper\[ros\]"):
        RosbridgeRobot.connect({}, {})


def test_pictures_come_out_of_messages() -> None:
    pixels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    shape = {"height": 2, "width": 4, "step": 12}
    data = base64.b64encode(pixels.tobytes()).decode()
    assert np.array_equal(picture_of({**shape, "encoding": "rgb8", "data": data}), pixels)
    flipped = picture_of({**shape, "encoding": "bgr8", "data": data})
    assert np.array_equal(flipped, pixels[:, :, ::-1])
    grey = picture_of({"height": 2, "width": 4, "step": 4, "encoding": "mono8", "data": data})
    assert grey.shape == (2, 4, 3)
    assert picture_of({"format": "png", "data": base64.b64encode(b"png").decode()}) == b"png"
    with pytest.raises(ValueError, match="expected 3 rows"):
        picture_of({**shape, "height": 3, "encoding": "rgb8", "data": data})
    assert message_type("/camera/image_raw/compressed").endswith("/CompressedImage")
    assert message_type("/camera/image_raw").endswith("/Image")

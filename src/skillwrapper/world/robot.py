"""The smallest way to bring a robot or simulator of one's own (docs/semantics.md D21).

A robot looks and runs skills::

    class MyRobot(skillwrapper.Robot):
        def look(self):
            return {"front": self.camera.read()}

        def run(self, skill, *arguments):
            return self.arm.do(skill, arguments)

``RobotEnvironment`` makes an ``Environment`` of it: it checks arguments, encodes pictures, and
turns mistakes of the robot's code into one sentence each.
"""

from __future__ import annotations

import inspect
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

import numpy as np

from skillwrapper.errors import PictureError, RobotError, SkillWrapperError
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import Look, observation_of
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance

RunResult: TypeAlias = "bool | tuple[bool, str] | Outcome"
"""Whether a skill succeeded; that and why not, for people; or a whole outcome."""


class Robot(ABC):
    """Base class of robots: ``look`` and ``run`` are needed, the others are not.

    Attributes:
        replayable: whether the same seed and skills give the same pictures, byte for byte; of
            simulators only. A run that was cut short then goes on in the middle of an episode.
        lasting: whether the world stays as it was left when the program ends, so that an episode
            can be taken up again, perhaps days later.
    """

    replayable: bool = False
    lasting: bool = False

    @abstractmethod
    def look(self) -> Look:
        """What is seen now: one picture, or pictures by the names of their cameras.

        A picture is an array (height, width, 3), the bytes or the path of an image file, or an
        image of Pillow. All cameras show up in every look.
        """

    @abstractmethod
    def run(self, skill: str, *arguments: str) -> RunResult:
        """Run a skill to its end; the arguments are names of objects that are present.

        Returns:
            Whether it succeeded, or that with a message for people, or an ``Outcome``. A skill that
            fails is no error: return False.

        Raises:
            RobotError: if the robot itself does not work and the run should stop.
        """

    def prepare(self, seed: int) -> None:  # noqa: B027
        """Bring the world to a start; may be declared as ``prepare(self, seed, scene)``.

        Args:
            seed: chooses what may differ between starts.
        """

    def scene(self) -> str | Iterable[str] | None:
        """What is present: a scene's name or names of objects; None for what was asked for."""
        return None

    def stop(self) -> None:  # noqa: B027
        """Release what the robot holds; is called once, at the end.

        A robot with an emergency stop has a method ``halted`` besides, which says why nothing may
        move now, or None.
        """


class RobotEnvironment:
    """A robot as an ``Environment``.

    Args:
        robot: looks and runs skills.
        domain: types, objects, skills and scenes.
    """

    def __init__(self, robot: Robot, domain: Domain) -> None:
        self._robot, self._domain = robot, domain
        self._scene = domain.scene()
        self._cameras: tuple[str, ...] = ()
        self._is_ready = self._is_stopped = False

    @property
    def domain(self) -> Domain:
        """Types, objects, skills and scenes."""
        return self._domain

    @property
    def scene(self) -> Scene:
        """What is present since the last reset."""
        return self._scene

    @property
    def replayable(self) -> bool:
        """Whether the robot says so."""
        return self._robot.replayable

    @property
    def lasting(self) -> bool:
        """Whether the robot says so."""
        return self._robot.lasting

    def take_up(self, scene: Scene) -> None:
        """Go on as the robot stands now, in a scene that is present."""
        self._scene, self._is_ready = scene, True

    def present(self, scene: str | None = None) -> Scene:
        """What is present now, as the robot says, or the scene that is asked for.

        Raises:
            UnknownNameError: if there is no such scene.
            RobotError: if the robot fails, or tells of objects that do not exist.
        """
        wanted = self._domain.scene(scene)
        return wanted if scene is not None else self._find_scene(wanted)

    def __getattr__(self, name: str) -> Any:
        """A robot may also have goals of its own (``Judged``), and an emergency stop."""
        if name in ("goals", "is_reached", "halted"):
            return getattr(self._robot, name)
        raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        """Let the robot prepare, and look.

        Raises:
            UnknownNameError: if there is no such scene.
            RobotError: if the robot fails, or stands in another scene than was asked for.
        """
        wanted = self._domain.scene(scene)
        self._is_ready = False
        keywords: dict[str, Any] = {"scene": wanted.name} if self._prepares_scenes() else {}
        self._call(f"prepare({seed})", lambda: self._robot.prepare(seed, **keywords))
        self._scene = self._find_scene(wanted)
        if scene is not None and self._scene.objects != wanted.objects:
            raise RobotError(
                f"scene(): expected scene '{scene}' ({', '.join(wanted.names)}) after prepare, "
                f"got {', '.join(self._scene.names)}; set it up and try again"
            )
        self._is_ready = True
        return self.observe()

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance.

        Raises:
            RobotError: before the first reset, or if the robot fails.
            UnknownNameError: if there is no such skill, or no such object in the scene.
            ConfigurationError: if the arguments do not fit the skill.
        """
        self._check_ready()
        self._domain.check_instance(instance, self._scene)
        what = f"run{(instance.skill, *instance.arguments)}"
        result = self._call(what, lambda: self._robot.run(instance.skill, *instance.arguments))
        if isinstance(result, Outcome):
            return result
        success, message = (
            result if isinstance(result, tuple) and len(result) == 2 else (result, "")
        )
        if not isinstance(success, bool | np.bool_) or not isinstance(message, str):
            raise RobotError(
                f"{what}: expected true or false, one of them with a message, or an Outcome; "
                f"got {result!r}"
            )
        return Outcome(bool(success), self.observe(), message)

    def observe(self) -> Observation:
        """Let the robot look.

        Raises:
            RobotError: before the first reset, if the robot fails, or shows no pictures or those of
                other cameras than before.
        """
        self._check_ready()
        try:
            seen = observation_of(self._call("look()", self._robot.look))
        except PictureError as error:
            raise RobotError(f"look(): {error}") from error
        cameras = tuple(picture.camera for picture in seen.pictures)
        self._cameras = self._cameras or cameras
        if set(cameras) != set(self._cameras):
            expected, got = ", ".join(self._cameras), ", ".join(cameras)
            raise RobotError(f"look(): expected pictures of {expected} as before, got {got}")
        return Observation(tuple(seen.picture(camera) for camera in self._cameras))

    def close(self) -> None:
        """Stop the robot; the second time nothing happens."""
        self._is_ready = False
        if not self._is_stopped:
            self._is_stopped = True
            self._call("stop()", self._robot.stop)

    def _check_ready(self) -> None:
        if not self._is_ready:
            raise RobotError("expected reset(seed=...) first, got another call")

    def _prepares_scenes(self) -> bool:
        return "scene" in inspect.signature(self._robot.prepare).parameters

    def _find_scene(self, wanted: Scene) -> Scene:
        told = self._call("scene()", self._robot.scene)
        if told is None:
            return wanted
        if isinstance(told, str):
            return self._domain.scene(told)
        names = tuple(told)
        for name in names:
            if name not in self._domain.object_by_name:
                known = ", ".join(self._domain.object_by_name)
                raise RobotError(f"scene(): expected objects of {known}; got '{name}'")
        present = Scene.of("-".join(sorted(names)), names, self._domain.objects)
        declared = (s for s in self._domain.scenes.values() if s.objects == present.objects)
        return next(declared, present)

    def _call(self, what: str, call: Callable[[], Any]) -> Any:
        """Call the robot's code; what it raises becomes one sentence with file and line."""
        try:
            return call()
        except SkillWrapperError:
            raise
        except Exception as error:
            place = _place(error, self._robot)
            raise RobotError(f"{what}: {type(error).__name__}: {error} ({place})") from error


def _place(error: Exception, robot: Robot) -> str:
    """The last line of the robot's own file that an error passed through, or else its last."""
    frames = traceback.extract_tb(error.__traceback__)
    own = inspect.getsourcefile(type(robot))
    frame = next((f for f in reversed(frames) if f.filename == own), frames[-1])
    return f"{frame.filename}:{frame.lineno}"

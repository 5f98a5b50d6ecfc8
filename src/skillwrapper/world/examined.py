"""An environment under examination: what it returns is looked at, what it raises is named."""

from __future__ import annotations

import io
import time
from collections.abc import Callable
from typing import Any, TypeVar

from PIL import Image, UnidentifiedImageError

from skillwrapper.errors import ConformanceError
from skillwrapper.world.capabilities import Replayable, Settable, require, supports
from skillwrapper.world.conformance_report import SkillTally
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance

Result = TypeVar("Result")


def expect(condition: bool, check: str, message: str) -> None:
    """Raise ``ConformanceError`` unless a condition holds."""
    if not condition:
        raise ConformanceError(check, message)


def expect_error(kind: type[Exception], check: str, what: str, call: Callable[[], object]) -> None:
    """Raise ``ConformanceError`` unless a call raises an error of a kind."""
    try:
        call()
    except kind:
        return
    except Exception as error:
        message = f"{what}: expected {kind.__name__}, got {error!r}"
        raise ConformanceError(check, message) from error
    raise ConformanceError(check, f"{what}: expected {kind.__name__}, got no error")


class Examined:
    """Calls an environment and checks everything it returns.

    Args:
        environment: has all members of the protocol.

    Attributes:
        picture_sizes: width and height of the pictures seen so far, by camera.
        skills: how the skills went so far, by name.
    """

    def __init__(self, environment: Environment) -> None:
        self.environment = environment
        self.picture_sizes: dict[str, tuple[int, int]] = {}
        self.skills: dict[str, SkillTally] = {}

    def reset(self, check: str, seed: int, scene: str | None = None) -> Observation:
        """Reset it, and check what is seen."""
        what = f"reset(seed={seed}, scene='{scene}')" if scene else f"reset(seed={seed})"
        seen = _called(check, what, lambda: self.environment.reset(seed=seed, scene=scene))
        return self._checked(seen, check, what)

    def observe(self, check: str) -> Observation:
        """Look, and check what is seen."""
        seen = _called(check, "observe()", self.environment.observe)
        return self._checked(seen, check, "observe()")

    def execute(self, check: str, instance: SkillInstance) -> Outcome:
        """Execute a skill instance, and check the outcome."""
        what = f"execute({instance})"
        began = time.monotonic()
        outcome: object = _called(check, what, lambda: self.environment.execute(instance))
        seconds = time.monotonic() - began
        if not isinstance(outcome, Outcome):
            kind = type(outcome).__name__
            raise ConformanceError(check, f"{what}: expected an Outcome, got {kind}")
        expect(
            isinstance(outcome.success, bool) and isinstance(outcome.message, str),
            check,
            f"{what}: expected true or false with a message, got {outcome.success!r} with "
            f"{outcome.message!r}",
        )
        self._checked(outcome.observation, check, what)
        tally = self.skills.get(instance.skill, SkillTally())
        self.skills[instance.skill] = tally.with_run(outcome.success, seconds)
        return outcome

    def _checked(self, seen: object, check: str, what: str) -> Observation:
        """What is seen, if each camera goes on giving pictures of one size."""
        observation = _checked_observation(seen, check, what)
        for picture in observation.pictures:
            size = picture.size
            expected = self.picture_sizes.setdefault(picture.camera, size)
            expect(
                size == expected,
                "picture sizes",
                f"{what}: expected pictures of '{picture.camera}' of {expected[0]} x {expected[1]} "
                f"pixels as before, got {size[0]} x {size[1]}",
            )
        return observation

    @property
    def state(self) -> Any:
        """The present state; None if it cannot be read."""
        if not supports(self.environment, Settable):
            return None
        return require(self.environment, Settable, "comparing states").get_state()

    def snapshot(self, check: str) -> tuple[Any, str]:
        """State and pictures, as far as they can be compared; looks at the world."""
        repeats = supports(self.environment, Replayable)
        return self.state, self.observe(check).key if repeats else ""

    def expect_same(self, before: object, check: str, what: str) -> None:
        """Raise ``ConformanceError`` unless the present state is the one of a snapshot."""
        after = self.snapshot(check)
        expect(before == after, check, f"{what}: expected {before} as before, got {after}")


def _called(check: str, what: str, call: Callable[[], Result]) -> Result:
    try:
        return call()
    except Exception as error:
        raise ConformanceError(check, f"{what}: expected it to pass, got {error!r}") from error


def _checked_observation(seen: object, check: str, what: str) -> Observation:
    if not isinstance(seen, Observation):
        kind = type(seen).__name__
        raise ConformanceError(check, f"{what}: expected an Observation, got {kind}")
    cameras = [picture.camera for picture in seen.pictures]
    expect(bool(cameras), "pictures", f"{what}: expected at least one picture, got none")
    expect(
        len(set(cameras)) == len(cameras),
        "pictures",
        f"{what}: expected a different camera each, got {cameras}",
    )
    for picture in seen.pictures:
        kind = _picture_format(picture.png)
        expect(kind == "PNG", "pictures", f"{what}: expected PNG of '{picture.camera}', got {kind}")
    return seen


def _picture_format(png: bytes) -> str:
    try:
        with Image.open(io.BytesIO(png)) as image:
            image.load()
            return image.format or "an unknown format"
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError):
        return "no picture"

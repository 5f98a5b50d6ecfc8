"""A robot that looks and runs skills is a whole environment, and its mistakes are told."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lamp_environment import LAMP_DOMAIN
from PIL import Image

import skillwrapper
from skillwrapper.errors import ConfigurationError, ConformanceError, RobotError, UnknownNameError
from skillwrapper.world import (
    Judged,
    Object,
    Outcome,
    Replayable,
    RobotEnvironment,
    Scene,
    SkillInstance,
    observation_of,
)
from skillwrapper.world.capabilities import capabilities_of, supports
from skillwrapper.world.conformance import check_environment

LIGHT = SkillInstance("Light", ("hand", "lamp"))
TWO_SCENES = replace(
    LAMP_DOMAIN,
    declared_scenes=(
        Scene("lamp", LAMP_DOMAIN.objects),
        Scene("dark", LAMP_DOMAIN.objects[:1]),
    ),
)


class LampRobot(skillwrapper.Robot):
    """Sees the lamp with two cameras, each look with other noise."""

    def __init__(self) -> None:
        self.lit = False
        self.stopped = 0
        self.ran: list[tuple[str, ...]] = []
        self._noise = np.random.default_rng(0)

    def look(self) -> Any:
        grey = self._noise.integers(0, 40, (4, 6, 3), dtype=np.uint8)
        return {"front": grey + np.uint8(200 * self.lit), "side": grey}

    def run(self, skill: str, *arguments: str) -> Any:
        self.ran.append((skill, *arguments))
        wanted = skill == "Light"
        success, self.lit = self.lit != wanted, wanted
        return success

    def prepare(self, seed: int) -> None:
        self.lit = False

    def stop(self) -> None:
        self.stopped += 1


def environment(robot: skillwrapper.Robot | None = None) -> RobotEnvironment:
    return RobotEnvironment(robot or LampRobot(), LAMP_DOMAIN)


def test_robot_keeps_all_rules_of_a_robot() -> None:
    check_environment(environment)
    made = environment()
    assert capabilities_of(made) == ()
    assert not supports(made, Replayable)


def test_robot_looks_and_runs_skills() -> None:
    robot = LampRobot()
    made = environment(robot)
    start = made.reset(seed=3)
    assert [p.camera for p in start.pictures] == ["front", "side"]
    outcome = made.execute(LIGHT)
    assert (outcome.success, outcome.message, outcome.changed) == (True, "", None)
    assert outcome.observation.picture("front") != start.picture("front")
    assert not made.execute(LIGHT).success
    assert robot.ran == [("Light", "hand", "lamp")] * 2
    made.close()
    made.close()
    assert robot.stopped == 1


def test_robot_is_not_troubled_with_what_it_cannot_do() -> None:
    robot = LampRobot()
    made = environment(robot)
    for call in (made.observe, lambda: made.execute(LIGHT)):
        with pytest.raises(RobotError, match="expected reset"):
            call()
    made.reset(seed=0)
    with pytest.raises(UnknownNameError, match="unknown skill 'Ligth'; did you mean 'Light'"):
        made.execute(SkillInstance("Ligth", ("hand", "lamp")))
    with pytest.raises(UnknownNameError, match="unknown object 'lump'"):
        made.execute(SkillInstance("Light", ("hand", "lump")))
    with pytest.raises(ConfigurationError, match="expected different objects of the types"):
        made.execute(SkillInstance("Light", ("lamp", "hand")))
    assert robot.ran == []


@pytest.mark.parametrize(
    ("result", "expected"),
    [
        (True, (True, "")),
        (np.bool_(False), (False, "")),
        ((False, "no power"), (False, "no power")),
        ((np.True_, ""), (True, "")),
    ],
)
def test_results_may_come_in_several_forms(result: object, expected: tuple[bool, str]) -> None:
    class Made(LampRobot):
        def run(self, skill: str, *arguments: str) -> Any:
            return result

    made = environment(Made())
    made.reset(seed=0)
    outcome = made.execute(LIGHT)
    assert (outcome.success, outcome.message) == expected
    assert type(outcome.success) is bool


def test_robot_may_say_what_it_saw_and_whether_anything_changed() -> None:
    class Sure(LampRobot):
        def run(self, skill: str, *arguments: str) -> Any:
            return Outcome(False, observation_of(self.look()), "stuck", changed=False)

    made = environment(Sure())
    made.reset(seed=0)
    outcome = made.execute(LIGHT)
    assert (outcome.success, outcome.message, outcome.changed) == (False, "stuck", False)


def test_pictures_may_be_files_and_single(tmp_path: Path) -> None:
    Image.new("RGB", (3, 2), (9, 8, 7)).save(tmp_path / "seen.jpg")

    class Filming(LampRobot):
        def look(self) -> Any:
            return tmp_path / "seen.jpg"

    made = environment(Filming())
    (picture,) = made.reset(seed=0).pictures
    assert picture.camera == "main"
    check_environment(lambda: environment(Filming()))


class Told(LampRobot):
    """Says where it is, and is told where it should be."""

    present: str | Iterable[str] | None = None

    def prepare(self, seed: int, scene: str = "") -> None:
        super().prepare(seed)
        self.wanted = scene

    def scene(self) -> str | Iterable[str] | None:
        return self.present


@pytest.mark.parametrize(
    ("present", "asked", "found"),
    [
        (None, None, "lamp"),
        (None, "dark", "dark"),
        ("dark", None, "dark"),
        (["hand"], None, "dark"),
        (["lamp", "hand"], None, "lamp"),
        (["lamp"], None, Scene("lamp", (Object("lamp", ("lamp",)),))),
    ],
)
def test_robot_may_tell_its_scene(present: Any, asked: str | None, found: str | Scene) -> None:
    robot = Told()
    robot.present = present
    made = RobotEnvironment(robot, TWO_SCENES)
    made.reset(seed=0, scene=asked)
    assert made.scene == (TWO_SCENES.scene(found) if isinstance(found, str) else found)
    assert robot.wanted == (asked or "lamp")
    if "lamp" not in made.scene.names:
        with pytest.raises(UnknownNameError, match="unknown object 'lamp'; known: hand"):
            made.execute(LIGHT)


def test_robot_in_another_scene_than_was_asked_for_is_told() -> None:
    robot = Told()
    robot.present = "lamp"
    made = RobotEnvironment(robot, TWO_SCENES)
    with pytest.raises(RobotError, match=r"scene\(\): expected scene 'dark' \(hand\) after prepa"):
        made.reset(seed=0, scene="dark")
    robot.present = ["elephant"]
    with pytest.raises(RobotError, match=r"scene\(\): expected objects of hand, lamp; got 'elep"):
        made.reset(seed=0)


def test_robot_may_have_goals() -> None:
    class Judging(LampRobot):
        goals = ("lit",)

        def is_reached(self, goal: str) -> bool:
            if goal != "lit":
                raise UnknownNameError("goal", goal, self.goals)
            return self.lit

    made = environment(Judging())
    assert supports(made, Judged)
    check_environment(lambda: environment(Judging()))


class Raises(LampRobot):
    def run(self, skill: str, *arguments: str) -> Any:
        return {}["arm"]


class Nothing(LampRobot):
    def run(self, skill: str, *arguments: str) -> Any:
        return None


class Blind(LampRobot):
    def look(self) -> Any:
        return {}


class LosesCamera(LampRobot):
    def look(self) -> Any:
        seen = super().look()
        return {"front": seen["front"]} if self.lit else seen


class SeesText(LampRobot):
    def look(self) -> Any:
        return b"a dark room"


class Unprepared(LampRobot):
    def prepare(self, seed: int) -> None:
        raise ConnectionError("no route to the arm")


class BrokenDown(LampRobot):
    def run(self, skill: str, *arguments: str) -> Any:
        raise RobotError("the battery is empty")


class Unstoppable(LampRobot):
    def stop(self) -> None:
        raise OSError("stuck")


def use(made: RobotEnvironment) -> None:
    made.reset(seed=0)
    made.execute(LIGHT)
    made.close()


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (Raises, r"run('Light', 'hand', 'lamp'): KeyError: 'arm' (" + __file__ + ":"),
        (Nothing, "run('Light', 'hand', 'lamp'): expected true or false, one of them with a mes"),
        (Blind, "look(): expected at least one picture, got none"),
        (LosesCamera, "look(): expected pictures of front, side as before, got front"),
        (SeesText, "look(): camera 'main': expected a picture"),
        (Unprepared, "prepare(0): ConnectionError: no route to the arm ("),
        (BrokenDown, "the battery is empty"),
        (Unstoppable, "stop(): OSError: stuck ("),
    ],
)
def test_mistakes_of_a_robot_are_told(robot: Callable[[], LampRobot], message: str) -> None:
    with pytest.raises(RobotError, match=re.escape(message)):
        use(environment(robot()))
    with pytest.raises(ConformanceError):
        check_environment(lambda: environment(robot()))


def test_the_documented_classes_work(tmp_path: Path) -> None:
    """The two classes in docs/domains.md, with what they leave open."""
    page = (Path(__file__).parents[2] / "docs" / "domains.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    declared = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)[0]
    (tmp_path / "domain.yaml").write_text(declared)
    domain = skillwrapper.load_domain(tmp_path / "domain.yaml")
    names: dict[str, Any] = {
        "draw_cups": lambda names, state, layout: np.full((4, 4), len(names) * len(state)) / 9,
        "input": lambda text: "",
    }
    exec("import skillwrapper\n" + "\n".join(blocks), names)

    class Arm:
        camera = arm = property(lambda self: self)
        read = release = do = lambda self, *_: np.ones((3, 3))

    class Robot(names["CupRobot"], Arm):  # type: ignore[misc]
        def run(self, skill: str, *arguments: str) -> Any:
            super().run(skill, *arguments)
            return False, "why"

    assert check_environment(lambda: RobotEnvironment(Robot(), domain)) == "robot"
    assert check_environment(lambda: names["CupWorld"](domain)) == "simulator"


def test_checking_a_robot_asks_for_one_start_only() -> None:
    """Somebody may have to set the world up by hand."""
    prepared: list[int] = []

    class Heavy(LampRobot):
        def prepare(self, seed: int) -> None:
            prepared.append(seed)

    assert check_environment(lambda: environment(Heavy()), seed=7) == "robot"
    assert prepared == [7]

"""A small domain package of its own, written into a folder: a cup that can be filled.

Its robot stands in one file and what it draws with in another one beside it.
"""

from __future__ import annotations

from pathlib import Path

DOMAIN = """\
name: tea
agent: A hand.
description: A cup on a table.
robot: robot.py:TeaWorld
types:
  hand: {}
  cup: {}
objects:
  hand: {types: [hand]}
  mug: {types: [cup]}
  glass: {types: [cup]}
skills:
  Fill: {parameters: [{name: hand, type: hand}, {name: cup, type: cup}]}
  Empty: {parameters: [{name: hand, type: hand}, {name: cup, type: cup}]}
scenes:
  kitchen: [hand, mug, glass]
  desk: [hand, mug]
"""

ROBOT = """\
from drawing import draw
from skillwrapper.errors import RobotError
from skillwrapper.world import Observation, Outcome, Picture


class TeaWorld:
    replayable = True

    def __init__(self, domain):
        self.domain = domain
        self.scene = domain.scene()
        self.full = None

    def reset(self, *, seed, scene=None):
        self.scene, self.full = self.domain.scene(scene), set()
        return self.observe()

    def execute(self, instance):
        seen = self.observe()
        self.domain.check_instance(instance, self.scene)
        success = (instance.arguments[1] in self.full) == (instance.skill == "Empty")
        if success:
            self.full ^= {instance.arguments[1]}
        return Outcome(success, self.observe())

    def observe(self):
        if self.full is None:
            raise RobotError("expected reset first")
        return Observation((Picture(draw(self.scene.names, self.full)),))

    def close(self):
        pass
"""

SMALLEST = """\
import skillwrapper
from drawing import draw


class TeaWorld(skillwrapper.Robot):
    def look(self):
        return {"front": draw(["mug"], set())}

    def run(self, skill, *arguments):
        return skill == "Fill"
"""

DRAWING = """\
from PIL import Image

from skillwrapper.world import encode_png


def draw(names, full):
    image = Image.new("RGB", (8, 8), (10 * len(names), 0, 0))
    for number, name in enumerate(sorted(full)):
        image.putpixel((number, len(name)), (0, 255, 0))
    return encode_png(image)
"""


def write_tea_world(folder: Path, **files: str) -> Path:
    """Write the package; files may be replaced by their names without ending, or added."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "domain.yaml").write_text(files.pop("domain", DOMAIN), encoding="utf-8")
    for name, text in {"robot": ROBOT, "drawing": DRAWING, **files}.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder

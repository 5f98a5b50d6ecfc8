"""A domain in a folder of its own: lamps on a shelf and in a window, that a hand lights."""

from __future__ import annotations

from pathlib import Path

DOMAIN = """\
name: shop
agent: A hand that reaches every lamp.
description: Lamps side by side; a lamp that is lit is bright.
failures_change_nothing: true
robot: shop.py:{robot}
{parts}
types:
  lamp: {{description: a lamp}}
  bulb: {{parents: [lamp], description: a lamp of glass}}
  lantern: {{parents: [lamp], description: a lamp of paper}}
objects:
  red: {{types: [bulb], description: a red lamp}}
  blue: {{types: [bulb], description: a blue lamp}}
  green: {{types: [lantern], description: a green lamp}}
scenes:
  shelf: [red, blue]
  window: [green]
skills:
  Light:
    description: The hand lights a lamp.
    parameters: [{{name: lamp, type: lamp, role: the lamp to light}}]
  PutOut:
    description: The hand puts a lamp out.
    parameters: [{{name: lamp, type: lamp, role: the lamp to put out}}]
"""
PARTS = """\
scene_reader: shop.py:read_lamps
system_predicates: shop.py:FACTS
"""
CODE = '''\
import io

from PIL import Image

from skillwrapper import Outcome, Simulator
from skillwrapper.embedded import SceneGraph
from skillwrapper.embedded.scene_graph import Box, Thing
from skillwrapper.symbols import Predicate

LAMPS = ("red", "blue", "green")
FACTS = (Predicate("lit", ("lamp",), "The lamp is lit."),)


class Shop(Simulator[frozenset[str]]):
    """States are the lamps that are lit."""

    def start(self):
        return frozenset()

    def obstacle(self, state, instance):
        wanted = instance.skill == "Light"
        return "nothing to do" if (instance.arguments[0] in state) is wanted else None

    def effect(self, state, instance):
        return state ^ {instance.arguments[0]}

    def draw(self, state, layout):
        image = Image.new("RGB", (30 * len(LAMPS), 30), (0, 0, layout % 40))
        for place, lamp in enumerate(LAMPS):
            if lamp in self.scene.names:
                shade = (250, 250, 200) if lamp in state else (90, 90, 90)
                image.paste(shade, (30 * place + 5, 5, 30 * place + 25, 25))
        return image

    def true_atoms(self, state):
        return (("lit", (lamp,)) for lamp in self.scene.names if lamp in state)

    @property
    def goals(self):
        return ("all_lit",)

    def is_reached(self, goal):
        return set(self.scene.names) == self.get_state()


class Bare:
    """The same as a robot: it can be reset and runs skills, and tells nothing else."""

    def __init__(self, domain):
        self._inner = Shop(domain)
        self.domain = domain

    @property
    def scene(self):
        return self._inner.scene

    def reset(self, *, seed, scene=None):
        return self._inner.reset(seed=seed, scene=scene)

    def execute(self, instance):
        return self._inner.execute(instance)

    def observe(self):
        return self._inner.observe()

    def close(self):
        self._inner.close()


def read_lamps(png):
    image = Image.open(io.BytesIO(png)).convert("RGB")
    if image.size != (30 * len(LAMPS), 30):
        return SceneGraph(())
    colours = {lamp: image.getpixel((30 * n + 15, 15)) for n, lamp in enumerate(LAMPS)}
    seen = {lamp: colour for lamp, colour in colours.items() if colour[0]}
    return SceneGraph(
        tuple(
            Thing(lamp, "lamp", Box(30 * LAMPS.index(lamp), 0, 30 * LAMPS.index(lamp) + 30, 30))
            for lamp in seen
        ),
        attributes={lamp: {"lit": colour[0] > 200} for lamp, colour in seen.items()},
    )
'''


def write_lamp_shop(folder: Path, *, robot: str = "Shop", parts: str = PARTS) -> Path:
    """A new folder with the domain; returns it.

    Args:
        folder: where.
        robot: ``Shop``, which can do everything, or ``Bare``, which runs skills.
        parts: further lines of its ``domain.yaml``.
    """
    folder.mkdir(parents=True)
    (folder / "shop.py").write_text(CODE)
    (folder / "domain.yaml").write_text(DOMAIN.format(robot=robot, parts=parts))
    return folder

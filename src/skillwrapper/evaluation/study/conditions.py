"""Under which conditions pictures are shown to a model."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from PIL import Image, ImageEnhance, ImageFilter

from skillwrapper.errors import UnknownNameError
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.pictures import encode_png

Distortion = Callable[[Image.Image], Image.Image]


@dataclass(frozen=True)
class Condition:
    """A way in which pictures differ from those that the robot usually sees.

    Attributes:
        name: what it is called in tables and options.
        meaning: what is done, for people.
        distort: changes a picture; None leaves it as it is.
        layouts: whether every picture shows an arrangement of its own.
        redrawn: whether the objects are drawn in another way, if the domain has one.
        drawing: in which of the domain's ways; empty for the first.
    """

    name: str
    meaning: str
    distort: Distortion | None = None
    layouts: bool = False
    redrawn: bool = False
    drawing: str = ""

    @property
    def needs_simulator(self) -> bool:
        """Whether the pictures have to be drawn anew."""
        return self.layouts or self.redrawn

    def apply(self, observation: Observation) -> Observation:
        """The observation as it is shown under this condition."""
        if self.distort is None:
            return observation
        return Observation(
            tuple(Picture(_distorted(p.png, self.distort), p.camera) for p in observation.pictures)
        )


def _distorted(png: bytes, distort: Distortion) -> bytes:
    with Image.open(io.BytesIO(png)) as image:
        return encode_png(distort(image.convert("RGB")))


def _brightness(factor: float) -> Distortion:
    return lambda image: ImageEnhance.Brightness(image).enhance(factor)


def _contrast(factor: float) -> Distortion:
    return lambda image: ImageEnhance.Contrast(image).enhance(factor)


def _blur(radius: float) -> Distortion:
    return lambda image: image.filter(ImageFilter.GaussianBlur(radius))


def _compression(quality: int) -> Distortion:
    def compress(image: Image.Image) -> Image.Image:
        data = io.BytesIO()
        image.save(data, "JPEG", quality=quality)
        with Image.open(data) as compressed:
            return compressed.convert("RGB")

    return compress


_ALL = (
    Condition("clean", "the pictures of one arrangement as they are"),
    Condition("layouts", "another arrangement in every picture", layouts=True),
    Condition("bright", "brightness times 1.4", _brightness(1.4)),
    Condition("dark", "brightness times 0.55", _brightness(0.55)),
    Condition("flat", "contrast times 0.5", _contrast(0.5)),
    Condition("harsh", "contrast times 1.6", _contrast(1.6)),
    Condition("blur", "Gaussian blur with a radius of 3 pixels", _blur(3)),
    Condition("jpeg", "JPEG compression with quality 10", _compression(10)),
    Condition("drawing", "another drawing of the same objects", redrawn=True),
)
CONDITIONS: Final[Mapping[str, Condition]] = MappingProxyType({c.name: c for c in _ALL})
"""All conditions by name; how strong they are was fixed before anything was measured."""


_ONE_DRAWING: Final = "drawing:"


def find_conditions(names: Sequence[str]) -> tuple[Condition, ...]:
    """Conditions by their names; all if there are no names.

    Args:
        names: of ``CONDITIONS``, or ``drawing:NAME`` for one of the domain's drawings: another
            camera, other light, other instances.

    Raises:
        UnknownNameError: if there is no such condition.
    """
    return tuple(_find(name) for name in dict.fromkeys(names)) or _ALL


def _find(name: str) -> Condition:
    drawing = name.removeprefix(_ONE_DRAWING)
    if drawing != name:
        return Condition(name, f"the drawing '{drawing}'", redrawn=True, drawing=drawing)
    if name not in CONDITIONS:
        raise UnknownNameError("condition", name, (*CONDITIONS, f"{_ONE_DRAWING}NAME"))
    return CONDITIONS[name]

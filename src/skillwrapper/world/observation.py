"""What the robot sees: one picture for each camera."""

from __future__ import annotations

import hashlib
import struct
from dataclasses import dataclass, field
from functools import cached_property

from skillwrapper.errors import UnknownNameError


@dataclass(frozen=True)
class Picture:
    """An encoded PNG picture of one camera.

    Attributes:
        png: the bytes of the PNG file.
        camera: which camera took it.
    """

    png: bytes = field(repr=False)
    camera: str = "main"

    @cached_property
    def sha256(self) -> str:
        """Hexadecimal SHA-256 of the PNG bytes; the identity of the picture on disk."""
        return hashlib.sha256(self.png).hexdigest()

    @cached_property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        width, height = struct.unpack(">II", self.png[16:24])
        return width, height


@dataclass(frozen=True)
class Observation:
    """What all cameras show at one moment.

    Attributes:
        pictures: at least one, a different camera each, in the order of the cameras.
    """

    pictures: tuple[Picture, ...]

    @cached_property
    def key(self) -> str:
        """Identity by content: equal pictures from equal cameras give equal keys."""
        if len(self.pictures) == 1:
            return self.pictures[0].sha256
        joined = "|".join(f"{p.camera}:{p.sha256}" for p in self.pictures)
        return hashlib.sha256(joined.encode()).hexdigest()

    def picture(self, camera: str | None = None) -> Picture:
        """The picture of a camera; None for the first one.

        Raises:
            UnknownNameError: if there is no such camera.
        """
        by_camera = {picture.camera: picture for picture in self.pictures}
        if camera is None:
            return self.pictures[0]
        if camera not in by_camera:
            raise UnknownNameError("camera", camera, by_camera)
        return by_camera[camera]

"""What the robot sees: one picture for each camera."""

from __future__ import annotations

import hashlib
import io
import struct
import zlib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from PIL import Image, UnidentifiedImageError

from skillwrapper.errors import PictureError, UnknownNameError

_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


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


def encode_png(image: Image.Image) -> bytes:
    """PNG bytes of an image in RGB; fast compression, the same bytes for the same pixels."""
    # Pillow tries five filters for every row, which takes longer than all the rest and gains
    # nothing on drawn pictures; so the rows are written here, unfiltered.
    pixels = np.asarray(image if image.mode == "RGB" else image.convert("RGB"))
    height, width = pixels.shape[:2]
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = pixels.reshape(height, 3 * width)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.data, 1)), (b"IEND", b""))
    return _PNG_SIGNATURE + b"".join(_png_chunk(kind, data) for kind, data in chunks)


def _png_chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def load_picture(path: Path, camera: str = "main") -> Picture:
    """Read a picture from a file; other formats than PNG are converted.

    Raises:
        PictureError: if the file is missing or is no picture.
    """
    try:
        data = path.read_bytes()
        with Image.open(io.BytesIO(data)) as image:
            image.load()
            png = data if image.format == "PNG" else encode_png(image.convert("RGB"))
    except FileNotFoundError as error:
        raise PictureError(f"{path}: no such picture") from error
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError) as error:
        raise PictureError(f"{path}: expected a picture (PNG, JPEG, ...)") from error
    return Picture(png, camera)

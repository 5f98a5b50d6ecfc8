"""What the robot sees: one picture for each camera."""

from __future__ import annotations

import hashlib
import io
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from PIL import Image, UnidentifiedImageError

from skillwrapper.errors import PictureError


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


def encode_png(image: Image.Image) -> bytes:
    """PNG bytes of an image; fast compression, the same bytes for the same pixels."""
    buffer = io.BytesIO()
    image.save(buffer, format="PNG", compress_level=1)
    return buffer.getvalue()


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

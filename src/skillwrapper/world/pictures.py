"""From what people have of a picture to PNG: arrays, files, bytes or images of Pillow."""

from __future__ import annotations

import io
import os
import struct
import warnings
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import ExifTags, Image, ImageOps, UnidentifiedImageError

from skillwrapper.errors import PictureError
from skillwrapper.files.bounded import read_bounded
from skillwrapper.world.observation import Observation, Picture

Shown: TypeAlias = "NDArray[Any] | bytes | str | os.PathLike[str] | Image.Image | Picture"
"""One picture: an array (height, width) or (height, width, channels) of bytes, of 16-bit numbers or
of fractions from 0 to 1; the bytes of an image file; the path of one; an image of Pillow."""

Look: TypeAlias = "Shown | Mapping[str, Shown] | Observation"
"""One picture, or pictures by the names of their cameras."""

MAIN_CAMERA: Final = "main"
_MOST_PIXELS = 50_000_000
_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def observation_of(look: Look) -> Observation:
    """The observation of what a robot looks at.

    Raises:
        PictureError: if something in it is no picture.
    """
    if isinstance(look, Observation):
        return look
    by_camera = look if isinstance(look, Mapping) else {MAIN_CAMERA: look}
    if not by_camera:
        raise PictureError("expected at least one picture, got none")
    return Observation(tuple(picture_of(shown, str(name)) for name, shown in by_camera.items()))


def picture_of(shown: Shown, camera: str = MAIN_CAMERA) -> Picture:
    """A picture from whatever shows it; files of PNG are kept byte for byte if they can be.

    Raises:
        PictureError: if it is no picture, or too large a one.
    """
    if isinstance(shown, Picture):
        return Picture(shown.png, camera)
    if isinstance(shown, bytes | bytearray | memoryview):
        return _decode(bytes(shown), camera, f"camera '{camera}'")
    if isinstance(shown, str | os.PathLike):
        return load_picture(Path(shown), camera)
    if isinstance(shown, Image.Image):
        return Picture(encode_png(upright(shown)), camera)
    return Picture(encode_png(_from_array(shown, camera)), camera)


_MOST_BYTES = 1 << 28
_PROGRAMS = frozenset({"EPS", "WMF"})
"""Formats that an interpreter outside would draw, which may do and take whatever the file says."""


def load_picture(path: Path, camera: str = MAIN_CAMERA) -> Picture:
    """Read a picture from a file; other formats than PNG are converted.

    Raises:
        PictureError: if the file is missing, is no picture, or too large a one.
    """
    try:
        data = read_bounded(path, _MOST_BYTES)
    except FileNotFoundError as error:
        raise PictureError(f"{path}: no such picture") from error
    except ValueError as error:  # a null character
        raise PictureError(f"{str(path)!r}: expected the name of a file") from error
    except OSError as error:
        raise PictureError(f"{path}: cannot be read ({error.strerror})") from error
    return _decode(data, camera, str(path))


def load_pictures(texts: list[str]) -> Observation:
    """An observation from paths, each after the name of its camera: ``front=a.png``.

    A single path needs no camera.

    Raises:
        PictureError: if a file cannot be read, or a camera is missing or given twice.
    """
    pairs = [_split_camera(text) for text in texts]
    cameras = [camera for camera, _ in pairs]
    if len(set(cameras)) < len(cameras):
        got = ", ".join(cameras)
        raise PictureError(f"expected pictures of different cameras (CAMERA=FILE), got {got}")
    return Observation(tuple(load_picture(path, camera) for camera, path in pairs))


def upright(image: Image.Image) -> Image.Image:
    """The image in RGB, turned as the camera was held; 16-bit grey keeps its upper bits."""
    turned = ImageOps.exif_transpose(image)
    if turned.mode.startswith("I;16") or turned.mode in ("I", "F"):
        return Image.fromarray(_as_bytes(np.asarray(turned))).convert("RGB")
    return turned.convert("RGB")


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


def _split_camera(text: str) -> tuple[str, Path]:
    camera, equals, path = text.partition("=")
    # A path may hold an equals sign itself.
    if not equals or Path(text).exists() or "/" in camera:
        return MAIN_CAMERA, Path(text)
    return camera, Path(path)


def _decode(data: bytes, camera: str, where: str) -> Picture:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image = Image.open(io.BytesIO(data))
        with image:
            if image.width * image.height > _MOST_PIXELS:
                raise _too_large(where)
            if image.format in _PROGRAMS:
                raise PictureError(f"{where}: expected a picture (PNG, JPEG, ...), got a program")
            image.load()
            if _is_plain(image):
                return Picture(data, camera)
            return Picture(encode_png(upright(image)), camera)
    except Image.DecompressionBombError as error:
        raise _too_large(where) from error
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError) as error:
        raise PictureError(f"{where}: expected a picture (PNG, JPEG, ...)") from error


def _is_plain(image: Image.Image) -> bool:
    """Whether the file can be shown to a model as it is."""
    turned = image.getexif().get(ExifTags.Base.Orientation, 1) != 1
    return image.format == "PNG" and image.mode in ("RGB", "RGBA", "L", "P") and not turned


def _too_large(where: str) -> PictureError:
    return PictureError(f"{where}: expected at most {_MOST_PIXELS // 10**6} million pixels")


def _from_array(shown: object, camera: str) -> Image.Image:
    array = np.asarray(shown)
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[:, :, 0]
    channels = array.shape[2] if array.ndim == 3 else 1
    if array.ndim not in (2, 3) or channels not in (1, 3, 4) or 0 in array.shape:
        raise PictureError(
            f"camera '{camera}': expected an array (height, width, 3), got {_describe(shown)}"
        )
    if array.shape[0] * array.shape[1] > _MOST_PIXELS:
        raise _too_large(f"camera '{camera}'")
    try:
        return Image.fromarray(_as_bytes(array)).convert("RGB")
    except (TypeError, ValueError) as error:
        raise PictureError(f"camera '{camera}': {error}") from error


def _as_bytes(array: NDArray[Any]) -> NDArray[np.uint8]:
    """Brightness from 0 to 255, by what the kind of numbers can hold."""
    if array.dtype == np.uint8:
        return np.ascontiguousarray(array)
    if array.dtype == np.bool_:
        return array.astype(np.uint8) * np.uint8(255)
    if array.dtype.kind == "f":
        if not (np.isfinite(array).all() and array.min() >= 0 and array.max() <= 1):
            raise ValueError("expected fractions from 0 to 1, got others")
        return np.asarray(np.rint(array * 255), dtype=np.uint8)
    if array.dtype.kind in "iu":
        largest = int(array.max())
        if array.min() < 0 or largest > 65_535:
            raise ValueError("expected numbers from 0 to 255 or to 65535, got others")
        wide = array.dtype == np.uint16 or largest > 255
        small: NDArray[np.uint8] = (array // 256 if wide else array).astype(np.uint8)
        return small
    raise ValueError(f"expected an array of numbers, got {array.dtype}")


def _describe(shown: object) -> str:
    shape = getattr(shown, "shape", None)
    return f"one of shape {tuple(shape)}" if shape else f"a {type(shown).__name__}"

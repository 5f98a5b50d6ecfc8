"""Moving pictures out of pictures, with nothing but Pillow."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Final, Self

from PIL import Image

from skillwrapper.errors import ConfigurationError
from skillwrapper.files.writing import write_atomically
from skillwrapper.world.capabilities import Filmed
from skillwrapper.world.observation import Picture

FRAME_SECONDS: Final = 0.08
"""From frame to frame, of the films of ``Filmed``."""
_LAST_SECONDS: Final = 1.5
_FORMATS: Final = {".webp": "WEBP", ".gif": "GIF", ".png": "PNG"}


class Film:
    """What an environment shows while it moves, from the beginning to the end of a ``with``.

    Args:
        environment: that is filmed.
    """

    def __init__(self, environment: Filmed) -> None:
        self._environment = environment
        self.frames: list[Picture] = []

    def __enter__(self) -> Self:
        self._environment.film(self.frames.append)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._environment.film(None)


def check_video_path(path: Path) -> None:
    """Make sure that a video can be written under a name.

    Raises:
        ConfigurationError: if its suffix is none of those that are known.
    """
    if path.suffix.lower() not in _FORMATS:
        known = ", ".join(_FORMATS)
        raise ConfigurationError(f"{path}: expected the name of a video to end in {known}")


def save_video(path: Path, frames: Sequence[Picture], seconds: float = FRAME_SECONDS) -> None:
    """Write a video that is repeated for ever, WebP, GIF or animated PNG by its suffix.

    Args:
        path: the file to write.
        frames: at least one picture.
        seconds: from frame to frame.

    Raises:
        ConfigurationError: if there are no frames, or the suffix is none of those.
        FileError: if the file cannot be written.
    """
    check_video_path(path)
    if not frames:
        raise ConfigurationError(f"{path}: expected something that moved, got no pictures of it")
    images = [Image.open(io.BytesIO(frame.png)).convert("RGB") for frame in frames]
    durations = [*(round(1000 * seconds) for _ in images[1:]), round(1000 * _LAST_SECONDS)]
    data = io.BytesIO()
    images[0].save(
        data,
        _FORMATS[path.suffix.lower()],
        save_all=True,
        append_images=images[1:],
        duration=durations,
        loop=0,
        quality=75,
    )
    write_atomically(path, data.getvalue())

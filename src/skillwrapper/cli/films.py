"""Filming what commands execute, where a file for it is named."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from skillwrapper.world.capabilities import Filmed, require
from skillwrapper.world.environment import Environment
from skillwrapper.world.videos import Film, check_video_path, save_video


@contextmanager
def filmed(environment: Environment, path: Path | None) -> Iterator[Film | None]:
    """Film an environment and write the video at the end; nothing without a path.

    Raises:
        ConfigurationError: if it cannot be filmed, nothing moved, or the file's name has another
            suffix than those of videos.
    """
    if path is None:
        yield None
        return
    check_video_path(path)
    with Film(require(environment, Filmed, "--video")) as film:
        yield film
    save_video(path, film.frames)

"""Keeping other processes out of a folder, also on media that nothing can be written to."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from skillwrapper.errors import RunFolderError
from skillwrapper.files.writing import explained


@contextmanager
def locked(folder: Path, otherwise: str) -> Iterator[None]:
    """Lock a folder that exists, without a file in it.

    The operating system lets go of it when the process ends, however it ends. A file system
    without locks keeps nobody out.

    Args:
        folder: what is locked.
        otherwise: what to say where another process has it.

    Raises:
        RunFolderError: if another process has it.
        FileNotWritableError: if it cannot be opened.
    """
    with explained(folder):
        handle = os.open(folder, os.O_RDONLY)
    try:
        _lock(handle, otherwise)
        yield
    finally:
        os.close(handle)


def _lock(handle: int, otherwise: str) -> None:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise RunFolderError(otherwise) from error
    except OSError:
        """A file system without locks."""

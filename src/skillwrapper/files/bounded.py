"""Reading a file that has an end: a device or a pipe named by mistake may have none."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

MOST_BYTES = 1 << 30
"""No file that we write, and no recording that we read, comes near."""


def read_bounded(path: Path, most: int = MOST_BYTES) -> bytes:
    """The content of a file.

    Args:
        path: the file.
        most: bytes that it may have.

    Raises:
        OSError: if it cannot be read, or is larger.
    """
    with _opened(path, most) as file:
        data = file.read(most + 1)  # devices tell no size
    if len(data) > most:
        raise _too_large(path)
    return data


def bounded_lines(path: Path, most: int = MOST_BYTES) -> Iterator[bytes]:
    """The lines of a file, one after the other in memory, with what ends them.

    Args:
        path: the file.
        most: bytes that it may have.

    Raises:
        OSError: if it cannot be read, or is larger.
    """
    with _opened(path, most) as file:
        while line := file.readline(most + 1):
            most -= len(line)
            if most < 0:
                raise _too_large(path)
            yield line


@contextmanager
def _opened(path: Path, most: int) -> Iterator[BinaryIO]:
    """The file, unless it says itself that it is too large."""
    with path.open("rb") as file:
        if os.fstat(file.fileno()).st_size > most:
            raise _too_large(path)
        yield file


def _too_large(path: Path) -> OSError:
    return OSError(errno.EFBIG, os.strerror(errno.EFBIG), str(path))

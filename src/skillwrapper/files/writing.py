"""Writing files so that neither a crash nor a device, link or folder in their place spoils them."""

from __future__ import annotations

import contextlib
import json
import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from skillwrapper.errors import FileError, FileNotWritableError

_TEMPORARY = ".tmp"
_KERNEL_FOLDERS = ("/dev/", "/proc/")
"""Names in them stand for open files and devices; nothing may be put in their place."""


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a file so that at any moment it is either the old one or the new one, whole.

    The content is on the disk when this returns. A link is followed; what is no regular file (a
    device, a pipe) is written through, and never replaced.

    Raises:
        FileError: if the path is a folder, or cannot be written.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    with explained(path):
        status = _status(path)
        if status is not None and stat.S_ISDIR(status.st_mode):
            raise FileError(f"{path}: expected the name of a file, got a folder")
        if _is_written_through(path, status):
            path.write_bytes(data)
            return
        target = path.resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        _replace(target, data, None if status is None else stat.S_IMODE(status.st_mode))


def write_json(path: Path, content: object) -> None:
    """Write JSON with sorted keys, atomically."""
    write_atomically(path, json_text(content))


def json_text(content: object) -> str:
    """JSON as files hold it: equal content, equal text."""
    return json.dumps(content, indent=1, sort_keys=True) + "\n"


def json_line(entry: Mapping[str, Any]) -> bytes:
    """A line of a file of JSON lines, with its end."""
    return json.dumps(entry, sort_keys=True).encode("utf-8") + b"\n"


def append_line(path: Path, entry: Mapping[str, Any], *, durable: bool = True) -> int:
    """Append a JSON line in a single write; a line before it that a crash cut short is removed.

    Args:
        path: the file; made if it does not exist.
        entry: plain data.
        durable: whether to wait until it is on the disk.

    Returns:
        How many bytes were appended.

    Raises:
        FileError: if the file cannot be written.
    """
    line = json_line(entry)
    with explained(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        is_new = not path.exists()
        with path.open("ab+") as file:
            _cut_torn_line(file.fileno())
            file.write(line)
            file.flush()
            if durable:
                os.fsync(file.fileno())
        if durable and is_new:
            _sync_folder(path.parent)
    return len(line)


def is_leftover(path: Path) -> bool:
    """Whether a file is what a crash left of writing another one."""
    return path.name.startswith(".") and path.suffix == _TEMPORARY


def remove_leftovers(folder: Path) -> None:
    """Remove what crashes left of writing files below a folder in which nobody else writes."""
    with contextlib.suppress(OSError):
        for leftover in filter(is_leftover, folder.rglob(".*")):
            leftover.unlink()


def _is_written_through(path: Path, status: os.stat_result | None) -> bool:
    if str(path.absolute()).startswith(_KERNEL_FOLDERS):
        return True
    return status is not None and not stat.S_ISREG(status.st_mode)


def _status(path: Path) -> os.stat_result | None:
    """What a path leads to; None if there is nothing yet."""
    try:
        return path.stat()
    except FileNotFoundError:
        return None


def _replace(target: Path, data: bytes, mode: int | None) -> None:
    """Put a new file in the place of a regular one, or where there is none."""
    temporary = target.with_name(f".{target.name}.{os.getpid()}{_TEMPORARY}")
    try:
        with temporary.open("wb") as file:
            if mode is not None:
                os.fchmod(file.fileno(), mode)
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(target)
    except BaseException:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise
    _sync_folder(target.parent)


def _sync_folder(folder: Path) -> None:
    """Make sure that the names in a folder are on the disk, where the system can do that."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _cut_torn_line(handle: int) -> None:
    """Cut a file off after its last whole line."""
    size = os.fstat(handle).st_size
    if size == 0 or os.pread(handle, 1, size - 1) == b"\n":
        return
    data = os.pread(handle, size, 0)
    os.ftruncate(handle, data.rfind(b"\n") + 1)


@contextmanager
def explained(path: Path) -> Iterator[None]:
    """Errors of the system in writing a file or folder, as one sentence.

    Raises:
        FileNotWritableError: instead of an ``OSError``.
    """
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise FileNotWritableError(f"{path}: cannot be written ({reason})") from error
    except ValueError as error:  # a null character in the name
        raise FileNotWritableError(f"{str(path)!r}: cannot be written ({error})") from error
